// SPDX-License-Identifier: GPL-3.0-or-later
// A preset that is added to another one: what the devices get, compared with what they get from each of the two alone.
#include <host/app/compose/add_preset.hpp>
#include <host/app/compose/banks.hpp>
#include <host/app/compose/removal.hpp>
#include <host/app/layers/mixer.hpp>
#include <host/app/problems/fixes.hpp>
#include <host/app/problems/unfelt.hpp>
#include <host/app/storage/snapshots.hpp>

#include <host/base/assets/file_assets.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/graph/ids.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/engine.hpp>

#include "support/property.hpp"
#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::compose;

namespace
{
namespace fs = std::filesystem;

const fs::path presets = TACTUS_SOURCE_DIR "/graphs";

std::vector<fs::path> presetFiles()
{
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator (presets))
        if (entry.path().extension() == ".json") files.push_back (entry.path());
    std::ranges::sort (files);
    return files;
}

graph::Graph preset (const std::string& name) { return loadGraph (presets / (name + ".json")).graph; }

/// A tool on a path that no force changes: it strokes, taps, and presses deep. The role chooses where the path begins.
class Guided final : public Device
{
public:
    explicit Guided (const std::string& role) : phase (0.01 * static_cast<double> (role.size())) {}

    void prepare (double dt_s) override { dt = dt_s; }
    Reading read() noexcept override
    {
        const double t = static_cast<double> (ticks++) * dt + phase, turn = 2.0 * std::numbers::pi;
        const double deep = 60e-3 * std::max (0.0, std::sin (turn * 5.0 * t) - 0.5);
        return { .position = { 30e-3 * std::sin (turn * 3.0 * t), 10e-3 * std::sin (turn * 2.0 * t), 1.5e-3 * std::sin (turn * 8.0 * t) - 0.5e-3 - deep } };
    }
    void write (const Effort& e) noexcept override { efforts.push_back (e); }

    std::vector<Effort> efforts;

private:
    double phase, dt = 0.0;
    std::uint64_t ticks = 0;
};

/// A tool that a hand presses into what is below: held in place, or by a spring.
class Pressed final : public Device
{
public:
    explicit Pressed (bool s) : is_sprung (s) {}

    void prepare (double dt_s) override { dt = dt_s; }
    Reading read() noexcept override { return { .position = place }; }
    void write (const Effort& e) noexcept override
    {
        forces.push_back (e.force);
        if (! is_sprung) return;
        const Vec3 all = e.force + 500.0 * (Vec3 { 0.0, 0.0, -2e-3 } - place) - 5.0 * velocity;   // N/m, N s/m
        velocity += all / 0.1 * dt;                                                               // kg
        place += velocity * dt;
    }

    std::vector<Vec3> forces;

private:
    bool is_sprung;
    Vec3 place { 0.0, 0.0, -1e-3 }, velocity = Vec3::Zero();
    double dt = 0.0;
};

/// The signals that the devices get from a graph, by role. `path`: the role whose path the tool of a role follows.
std::map<std::string, std::vector<Effort>> played (const graph::Graph& g, double rate_hz, const RoleMap& path)
{
    FileAssets assets;
    auto compiled = compile (g, catalogue(), { .rate_hz = rate_hz, .assets = &assets });
    for (const auto& m : compiled.messages)
        if (m.severity == Message::Severity::error) FAIL (g.name << ": " << m.where << ": " << m.text);
    REQUIRE (compiled.plan != nullptr);
    std::map<std::string, Guided> tools;
    Engine engine (std::move (compiled.plan));
    for (const auto& role : rolesIn (g))
    {
        const auto to = path.find (role);
        engine.attach (role, tools.try_emplace (role, to == path.end() ? role : to->second).first->second);
    }
    for (int i = 0; i < 1200; ++i)
        engine.tick();
    std::map<std::string, std::vector<Effort>> all;
    for (auto& [role, tool] : tools)
        all[role] = std::move (tool.efforts);
    return all;
}

/// Adds a preset, and returns the graph afterwards.
graph::Graph with (const graph::Graph& open, const graph::Graph& added, const AddOptions& how, AddedPreset* made = nullptr)
{
    auto done = addPreset (open, added, how, catalogue());
    if (! done) FAIL (done.error().text);
    graph::History history (open);
    const auto before = writeGraph (history.graph());
    REQUIRE (history.perform (done->command));
    auto after = history.graph();
    REQUIRE (history.undo());
    CHECK (writeGraph (history.graph()) == before);
    CHECK (graph::idsOf (history.graph()) == graph::idsOf (open));
    CHECK (readGraph (writeGraph (after)).messages.empty());
    if (made != nullptr) *made = std::move (*done);
    return after;
}

bool hasWire (const graph::Graph& g, const std::string& text)
{
    return std::ranges::any_of (g.root.wires, [&] (const graph::Wire& w) { return graph::toText (w) == text; });
}

/// True if each motor of the graph gets one wire, from a mixer, and no motor is inside of a subgraph, where an exposed port may lead to it.
bool isMixed (const graph::Graph& g)
{
    const auto isMotor = [] (const graph::Node& n) { return ! sinkPortsOf (n).empty(); };
    for (const auto& [name, patch] : g.graphs)
        if (std::ranges::any_of (patch.nodes, isMotor)) return false;
    std::set<std::string> ends;
    return std::ranges::all_of (g.root.wires, [&] (const graph::Wire& w) {
        if (! isMotor (*g.root.find (w.to.node))) return true;
        return ends.insert (w.to.node + '.' + w.to.port).second && g.root.find (w.from.node)->type.starts_with ("layer.mix");
    });
}

/// True if the devices get nothing once each layer of the mixers before them is muted.
bool isSilentWhenMuted (graph::Graph g)
{
    for (auto& n : g.root.nodes)
        if (n.type.starts_with ("layer.mix") && std::ranges::any_of (g.root.wires, [&] (const graph::Wire& w) {
                return w.from.node == n.name && ! sinkPortsOf (*g.root.find (w.to.node)).empty();
            }))
        {
            auto all = Json::array();
            for (int i = 0; i < layersOf (n, catalogue()); ++i)
                all.push_back (1.0);
            n.params["mute"] = all;
        }
    for (const auto& [role, efforts] : played (g, g.rate_hz, {}))
        for (const auto& e : efforts)
            if (e.force.norm() + e.torque.norm() > 0.0) return false;
    return true;
}

/// The largest difference between the sum of two graphs and both in one, in N and N m; and the largest force.
struct Difference
{
    double most = 0.0, strongest = 0.0;
};

Difference difference (const graph::Graph& open, const graph::Graph& added, const graph::Graph& both, const RoleMap& roles)
{
    const auto one = played (open, both.rate_hz, {}), other = played (added, both.rate_hz, roles), together = played (both, both.rate_hz, {});
    Difference d;
    for (const auto& [role, efforts] : together)
        for (std::size_t i = 0; i < efforts.size(); ++i)
        {
            Effort sum;
            if (const auto of = one.find (role); of != one.end()) sum = of->second[i];
            for (const auto& [theirs, more] : other)
            {
                const auto to = roles.find (theirs);
                if ((to == roles.end() ? theirs : to->second) != role) continue;
                sum.force += more[i].force;
                sum.torque += more[i].torque;
            }
            d.most = std::max ({ d.most, (sum.force - efforts[i].force).norm(), (sum.torque - efforts[i].torque).norm() });
            d.strongest = std::max (d.strongest, sum.force.norm());
        }
    return d;
}
}   // namespace

TEST_CASE ("a preset that is added to another one plays the sum of both, through mixers, and one undo brings back the bits of before", "[compose]")
{
    const auto files = presetFiles();
    REQUIRE (files.size() > 30);
    tactus::test::property ("random pairs of presets", [&] {
        const auto open = loadGraph (*rc::gen::elementOf (files)).graph, added = loadGraph (*rc::gen::elementOf (files)).graph;
        INFO (open.name << " + " << added.name);
        const auto maps = roleMaps (open, added);
        const auto roles = *rc::gen::elementOf (maps);
        RC_PRE (! roles.empty());   // with devices of their own, see below
        AddedPreset made;
        const auto both = with (open, added, { .roles = roles }, &made);
        CHECK (isMixed (both));
        CHECK (bypassedBanks (both, catalogue()).empty());
        CHECK (both.controls.size() == open.controls.size() + added.controls.size());
        CHECK (both.rate_hz == std::max (open.rate_hz, added.rate_hz));
        CHECK (both.devices.size() == open.devices.size() + rolesIn (added).size() - roles.size());
        CHECK (both.root.find (made.block) != nullptr);
        const auto d = difference (open, added, both, roles);
        CHECK (d.strongest > 1e-3);
        CHECK (d.most <= 1e-12 * (1.0 + d.strongest));
        CHECK (isSilentWhenMuted (both));   // every force is in a strip
    });
}

TEST_CASE ("each preset can be added to an empty graph, with its own devices, and to itself", "[compose]")
{
    for (const auto& file : presetFiles())
    {
        INFO (file.stem().string());
        const auto one = loadGraph (file).graph;
        graph::Graph empty;
        empty.rate_hz = one.rate_hz;
        REQUIRE (roleMaps (empty, one) == std::vector<RoleMap> { {} });
        const auto alone = with (empty, one, {});
        CHECK (isMixed (alone));
        CHECK (rolesIn (alone) == rolesIn (one));
        CHECK (alone.devices.size() == one.devices.size());
        const auto d = difference (empty, one, alone, {});
        CHECK (d.most <= 1e-12 * (1.0 + d.strongest));
        CHECK (unfelt (alone, catalogue()).empty());

        auto twice = with (one, loadGraph (file).graph, { .roles = roleMaps (one, one).front() });
        twice = with (twice, loadGraph (file).graph, { .roles = roleMaps (twice, one).front() });
        CHECK (isMixed (twice));
        CHECK (played (twice, twice.rate_hz, {}).size() == rolesIn (one).size());
    }
}

TEST_CASE ("an added preset is one node with its controls, and one layer of the mixer", "[compose]")
{
    const auto wood = preset ("dry_wood");
    AddedPreset made;
    const auto both = with (wood, preset ("zip"), { .roles = { { "slider", "stylus" } }, .at = juce::Point<double> { 40.0, 80.0 } }, &made);
    CHECK (made.block == "zip_fastener");
    CHECK (made.label == "Zip fastener");
    REQUIRE (made.layers == std::vector<std::string> { "desk" });
    CHECK (both.root.nodes.size() == wood.root.nodes.size() + 2);   // the block and the mixer
    CHECK (both.root.find ("zip_fastener")->roles.value ("slider", std::string()) == "stylus");
    for (const char* wire : { "board.force -> desk.in[0]", "drag.force -> desk.in[1]", "grain_felt.out -> desk.in[2]", "zip_fastener.force -> desk.in[3]",
                              "desk.out -> motor.force" })
        CHECK (hasWire (both, wire));
    CHECK (layerNames (*both.root.find ("desk"), 4) == std::vector<std::string> { "board", "drag", "grain_felt", "Zip fastener" });
    const auto control = std::ranges::find (both.controls, "drag", &graph::Control::id);
    REQUIRE (control != both.controls.end());
    CHECK (control->to.front().path.starts_with ("zip_fastener/"));

    const auto again = with (both, preset ("dry_wood"), { .roles = { { "stylus", "stylus" } } }, &made);
    CHECK (made.block == "dry_wood");
    CHECK (layersOf (*again.root.find ("desk"), catalogue()) == 5);   // the mixer that was there
    const auto third = with (again, preset ("dry_wood"), { .roles = { { "stylus", "stylus" } } }, &made);
    CHECK (made.block == "dry_wood_2");
    CHECK (made.label == "Dry wood 2");
    CHECK (std::ranges::count (third.controls, "Roughness (Dry wood 2)", &graph::Control::name) == 1);
}

TEST_CASE ("an added preset that is removed takes its layer and its controls along, and nothing of others", "[compose]")
{
    AddedPreset zip, bell;
    const auto wood = with (preset ("dry_wood"), preset ("zip"), { .roles = { { "slider", "stylus" } } }, &zip);
    auto all = with (wood, preset ("bronze_bell"), { .roles = { { rolesIn (preset ("bronze_bell")).front(), "stylus" } } }, &bell);
    const auto isOfZip = [&] (const graph::Control& c) { return ! c.to.empty() && c.to.front().path.starts_with (zip.block + '/'); };
    auto shared = wood.controls.front();   // of the wood
    shared.id = "both";
    shared.to.push_back (std::ranges::find_if (wood.controls, isOfZip)->to.front());
    all.controls.push_back (shared);
    all.controls.push_back ({ "empty", "Empty", 0.5, {} });   // its user may fill it
    const auto* desk = all.root.find ("desk");
    const auto layers = layerNames (*desk, layersOf (*desk, catalogue()));
    REQUIRE (layers.size() == 5);

    auto left = all;
    const auto removal = withLeftovers (all, { "delete", { graph::RemoveNode { "", zip.block } } }, catalogue());
    const auto back = graph::apply (left, removal);
    REQUIRE (back);
    desk = left.root.find ("desk");
    CHECK (layerNames (*desk, layersOf (*desk, catalogue())) == std::vector<std::string> { layers[0], layers[1], layers[2], layers[4] });
    for (const auto& c : all.controls)
    {
        INFO (c.id);
        CHECK (std::ranges::count (left.controls, c.id, &graph::Control::id) == (isOfZip (c) ? 0 : 1));
    }
    REQUIRE (graph::apply (left, *back));
    CHECK (writeGraph (left) == writeGraph (all));

    // So does a layer that is felt only in contact, with its gate.
    auto gated = all;
    const auto at = mixersOf (gated).front();
    REQUIRE (graph::apply (gated, *setGate (gated, at, catalogue(), 3, true)));
    REQUIRE (isGated (gated, at, 3));
    const auto nodes = all.root.nodes.size(), with_gate = gated.root.nodes.size();
    REQUIRE (with_gate > nodes);
    REQUIRE (graph::apply (gated, withLeftovers (gated, { "delete", { graph::RemoveNode { "", zip.block } } }, catalogue())));
    CHECK (layersOf (*gated.root.find ("desk"), catalogue()) == 4);
    CHECK (gated.root.nodes.size() == with_gate - 2);   // without the block and the gate

    // A plain node leaves its layer, which has a name and values of its own; a mixer keeps its last layer.
    const auto plain = withLeftovers (all, { "delete", { graph::RemoveNode { "", "drag" } } }, catalogue());
    REQUIRE (graph::apply (left, plain));
    CHECK (layersOf (*left.root.find ("desk"), catalogue()) == 5);
    auto alone = with ({}, preset ("zip"), {}, &zip);
    REQUIRE (graph::apply (alone, withLeftovers (alone, { "delete", { graph::RemoveNode { "", zip.block } } }, catalogue())));
    CHECK (alone.controls.empty());
    const auto mixers = mixersOf (alone);
    REQUIRE (mixers.size() == 1);
    CHECK (layersOf (*findMixer (alone, mixers.front()), catalogue()) == 1);
}

TEST_CASE ("a snapshot gives the layers that are left their levels after an added preset is removed, and names what is gone", "[compose][snapshots]")
{
    AddedPreset zip;
    auto g = with (preset ("dry_wood"), preset ("zip"), { .roles = { { "slider", "stylus" } } }, &zip);
    g = with (g, preset ("bronze_bell"), { .roles = { { rolesIn (preset ("bronze_bell")).front(), "stylus" } } });
    const auto at = mixersOf (g).front();
    const auto layers = [&] { return layersOf (*findMixer (g, at), catalogue()); };
    const auto level = [&] (int layer) { return layerValue (*findMixer (g, at), catalogue(), "gain", layer); };
    const auto setLast = [&] (double gain) {
        REQUIRE (graph::apply (g, setLayerValue (*findMixer (g, at), at, catalogue(), "gain", layers() - 1, Json (gain))));
    };
    setLast (0.25);
    REQUIRE (graph::apply (g, storeSnapshot (g, 1)));
    setLast (0.75);
    REQUIRE (graph::apply (g, withLeftovers (g, { "delete", { graph::RemoveNode { "", zip.block } } }, catalogue())));
    REQUIRE (level (layers() - 1) == 0.75);
    CHECK (std::ranges::count (missingNodes (g, 1), zip.block) == 1);
    const auto recall = recallSnapshot (g, 1);
    REQUIRE (recall);
    REQUIRE (graph::apply (g, *recall));
    CHECK (level (layers() - 1) == 0.25);
    CHECK (level (layers() - 2) == 1.0);
}

TEST_CASE ("a part of a preset is added without its walls, and what rubs keeps its load", "[compose]")
{
    const auto pad = preset ("soft_pad"), wood = preset ("dry_wood");
    const RoleMap roles { { "stylus", "finger" } };
    const auto kinds = partsOf (wood, catalogue());
    CHECK (kinds == Parts { true, true, true, false, false });

    auto parts = Parts {};
    parts.walls = false;
    auto without = wood;
    std::erase_if (without.root.wires, [] (const graph::Wire& w) { return graph::toText (w) == "board.force -> motor.force"; });
    auto both = with (pad, wood, { .roles = roles, .parts = parts });
    CHECK (both.find ("dry_wood")->find ("board") != nullptr);
    CHECK (difference (pad, without, both, roles).most < 1e-12);

    parts = Parts::none();
    parts.textures = true;
    std::erase_if (without.root.wires, [] (const graph::Wire& w) { return graph::toText (w) == "drag.force -> motor.force"; });
    both = with (pad, wood, { .roles = roles, .parts = parts });
    CHECK (both.find ("dry_wood")->find ("drag") == nullptr);
    CHECK (difference (pad, without, both, roles).most < 1e-12);
    const auto roughness = std::ranges::find (both.controls, "roughness", &graph::Control::id);
    REQUIRE (roughness != both.controls.end());
    CHECK (roughness->to.size() == 1);   // no longer the friction

    parts = Parts::none();
    parts.vibrations = true;
    const auto none = addPreset (pad, wood, { .roles = roles, .parts = parts }, catalogue());
    REQUIRE_FALSE (none);
    CHECK (none.error().id == "compose/no_part");
}

TEST_CASE ("each part of each preset alone is a layer, and the parts of a preset add up to the whole", "[compose]")
{
    for (const auto& file : presetFiles())
    {
        INFO (file.stem().string());
        const auto one = loadGraph (file).graph;
        const auto all = partsOf (one, catalogue());
        graph::Graph sum;
        sum.rate_hz = one.rate_hz;
        sum.devices = one.devices;
        int count = 0;
        for (auto part : { &Parts::walls, &Parts::friction, &Parts::textures, &Parts::vibrations, &Parts::others })
        {
            if (! (all.*part)) continue;
            auto parts = Parts::none();
            parts.*part = true;
            const auto own = sum.root.nodes.empty() ? RoleMap {} : roleMaps (sum, one).front();
            auto added = addPreset (sum, loadGraph (file).graph, { .roles = own, .parts = parts }, catalogue());
            if (! added) FAIL (added.error().text);
            REQUIRE (graph::apply (sum, added->command));
            CHECK (isMixed (sum));
            ++count;
        }
        CHECK (count > 0);
        for (const auto& m : unfelt (sum, catalogue()))
            FAIL_CHECK (m.where << ": " << m.text);
    }
}

TEST_CASE ("motors inside of subgraphs come to the top, one for each role", "[compose]")
{
    const auto fingers = preset ("two_fingers");
    auto mixed = fingers;
    REQUIRE (mixAll (mixed, catalogue()));
    CHECK (isMixed (mixed));
    CHECK (rolesIn (mixed) == rolesIn (fingers));
    CHECK (std::ranges::count (mixed.root.nodes, "device.force", &graph::Node::type) == 2);
    const auto d = difference (fingers, {}, mixed, {});
    CHECK (d.strongest > 0.1);
    CHECK (d.most <= 1e-12);

    const auto maps = roleMaps (preset ("dry_wood"), fingers);
    REQUIRE (maps.size() == 3);
    CHECK (maps[0] == RoleMap { { "thumb", "stylus" } });   // the other finger keeps its device
    CHECK (maps[1] == RoleMap { { "thumb", "stylus" }, { "index", "stylus" } });
    CHECK (maps[2].empty());
    const auto both = with (preset ("dry_wood"), fingers, { .roles = maps[0] });
    CHECK (both.device ("index") != nullptr);
    CHECK (both.device ("thumb") == nullptr);
}

TEST_CASE ("what goes past a mixer is found, and becomes a layer in one step", "[compose]")
{
    auto wood = preset ("dry_wood");
    CHECK (bypassedBanks (wood, catalogue()).empty());   // there is no mixer to go past
    REQUIRE (mixAll (wood, catalogue()));
    tactus::test::Sketch more { wood };
    more.node ("hum", "texture.grating").wire ("hand.position -> hum.position").wire ("hum.force -> motor.force");
    const auto found = bypassedBanks (more.graph, catalogue());
    REQUIRE (found.size() == 1);
    CHECK (found[0].sink == "motor");
    CHECK (found[0].mixer == "desk");
    CHECK (found[0].sources == std::vector<std::string> { "hum.force" });
    const auto said = unfelt (more.graph, catalogue());
    REQUIRE (said.size() == 1);
    CHECK (said[0].id == "mixer/bypassed");
    const auto fix = fixOf (more.graph, said[0]);
    REQUIRE (fix);
    auto after = more.graph;
    REQUIRE (graph::apply (after, fix->command));
    CHECK (isMixed (after));
    CHECK (hasWire (after, "hum.force -> desk.in[3]"));
    CHECK (unfelt (after, catalogue()).empty());
    CHECK (difference (more.graph, {}, after, {}).most < 1e-12);
}

TEST_CASE ("several effects that reach a motor without a mixer are a problem with a fix, and one effect of several nodes is none", "[compose]")
{
    for (const auto& file : presetFiles())
    {
        INFO (file);
        CHECK (std::ranges::count (unfelt (loadGraph (file).graph, catalogue()), "mixer/none", &Message::id) == 0);
    }
    tactus::test::Sketch s { preset ("dry_wood") };   // a wall, a friction that it presses on, and grain that the wall opens
    s.node ("hum", "signal.lfo", { { "amplitude", "0.5 N" } }).node ("wave", "signal.lfo", { { "amplitude", 0.01 } });
    CHECK (bypassedBanks (s.graph, catalogue()).empty());
    s.wire ("wave.out -> (+) drag.mu");   // a modulator is no effect
    CHECK (bypassedBanks (s.graph, catalogue()).empty());
    s.wire ("hum.out -> motor.force.x");
    const auto said = unfelt (s.graph, catalogue());
    REQUIRE (said.size() == 1);
    CHECK (said[0].id == "mixer/none");
    CHECK (said[0].text.find ("hum.out") != std::string::npos);
    const auto fix = fixOf (s.graph, said[0]);
    REQUIRE (fix);
    CHECK (fix->label == "Mix them");
    auto after = s.graph;
    REQUIRE (graph::apply (after, fix->command));
    CHECK (isMixed (after));
    CHECK (unfelt (after, catalogue()).empty());
    CHECK (difference (s.graph, {}, after, {}).most < 1e-12);
}

TEST_CASE ("a graph that drives nothing cannot be a layer", "[compose]")
{
    const auto wood = preset ("dry_wood");
    tactus::test::Sketch silent;
    silent.node ("hand", "device.position").node ("noise", "signal.noise");
    const auto refused = addPreset (wood, silent.graph, {}, catalogue());
    REQUIRE_FALSE (refused);
    CHECK (refused.error().id == "compose/no_motor");
}

TEST_CASE ("a preset that is added under a pressed tool does not kick", "[app][compose]")
{
    constexpr int second = 4000;   // ticks
    const auto wood = preset ("dry_wood");
    const bool is_sprung = GENERATE (false, true);
    for (const auto& file : presetFiles())
    {
        INFO (file.stem() << (is_sprung ? ", by a spring" : ", in place"));
        const auto added = loadGraph (file).graph;
        RoleMap roles;
        for (const auto& role : rolesIn (added))
            roles[role] = "stylus";
        auto both = wood;
        const auto made = addPreset (wood, added, { .roles = roles }, catalogue());
        REQUIRE (made);
        REQUIRE (graph::apply (both, made->command));
        FileAssets assets;
        auto first = compile (wood, catalogue(), { .rate_hz = second, .assets = &assets });
        auto then = compile (both, catalogue(), { .rate_hz = second, .assets = &assets, .before = first.plan.get() });
        REQUIRE (first.plan);
        REQUIRE (then.plan);
        Engine engine (std::move (first.plan));
        Pressed tool (is_sprung);
        engine.attach ("stylus", tool);
        for (int k = 0; k < second; ++k)
            engine.tick();
        engine.submit (std::move (then.plan));
        for (int k = 0; k < second; ++k)
            engine.tick();

        const auto length = [&] (int k) { return tool.forces[static_cast<std::size_t> (k)].norm(); };
        constexpr int risen = second + 120 * second / 1000;
        double before = length (second - 1), most = 0.0, later = before, step = 0.0;
        for (int k = second; k < 2 * second; ++k)
        {
            auto& largest = k < risen ? most : later;
            largest = std::max (largest, length (k));
            step = std::max (step, (tool.forces[static_cast<std::size_t> (k)] - tool.forces[static_cast<std::size_t> (k) - 1]).norm());
        }
        CHECK (before > 0.5);
        CHECK (most <= 1.05 * later);
        CHECK (step <= 0.05);   // N; a fade to 8 N steps by 0.024 N, a heart beats with 0.035 N
    }
}
