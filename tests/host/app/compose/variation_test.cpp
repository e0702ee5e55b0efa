// SPDX-License-Identifier: GPL-3.0-or-later
// Morphs between two snapshots, and random values.
#include <host/app/compose/add_preset.hpp>
#include <host/app/compose/variation.hpp>
#include <host/app/layers/mixer_parts.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/value_in_effect.hpp>
#include <host/app/storage/snapshots.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/run/engine.hpp>

#include "support/sketch.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

using namespace tactus;
using namespace tactus::host;

namespace
{
void mustPerform (graph::History& h, graph::Command c)
{
    const auto done = h.perform (std::move (c));
    INFO ((done ? "" : done.error().text));
    REQUIRE (done);
}

/// The value of a parameter in the compiled graph, in SI.
double valueIn (const graph::Graph& g, const std::string& node, const std::string& param)
{
    const auto compiled = compile (g, catalogue());
    REQUIRE (compiled.plan);
    const auto& flat = compiled.plan->flat();
    for (int n = 0; n < flat.nodeCount(); ++n)
        if (flat.node (n).path == node)
        {
            const auto& rows = flat.node (n).type->params;
            const auto row = static_cast<std::size_t> (std::ranges::find (rows, param, &PortSheet::id) - rows.begin());
            return *compiled.plan->instances()[static_cast<std::size_t> (n)].param (plan::Knobs::indexOf (*flat.node (n).type, row, 0));
        }
    FAIL (node);
    return 0.0;
}

struct Tip final : public Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return {}; }
    void write (const Effort& e) noexcept override { force = e.force.z(); }

    double force = 0.0;
};

graph::Graph loud (double newtons)
{
    tactus::test::Sketch s;
    s.node ("a", "signal.constant", { { "value", newtons } }).node ("motor", "device.force").wire ("a.out -> motor.force.z");
    return s.graph;
}

/// Stores two snapshots that differ by one number, and returns the morph between them, and the file before it.
std::pair<Morph, std::string> morphOver (graph::History& h, graph::Command change)
{
    mustPerform (h, storeSnapshot (h.graph(), 1));
    mustPerform (h, std::move (change));
    mustPerform (h, storeSnapshot (h.graph(), 2));
    auto made = morphBetween (h.graph(), 1, 2, catalogue());
    REQUIRE (made);
    CHECK (made->params == 1);
    CHECK (made->left_out == 0);
    return { std::move (*made), writeGraph (h.graph()) };
}
}   // namespace

TEST_CASE ("a morph moves the numbers from one snapshot to another on a line, and one undo takes it away", "[snapshots]")
{
    auto s = tactus::test::Sketch { loud (1.0) };
    s.node ("wall", "deform.plane", { { "stiffness", "1 N/mm" } }).node ("hand", "device.position").wire ("hand.position -> wall.position");
    s.wire ("wall.force -> motor.force");
    graph::History h (s.graph);
    const auto [made, before] = morphOver (h, graph::SetParam { "", "wall", "stiffness", Json ("3 N/mm") });
    const auto steps = h.position();
    mustPerform (h, made.command);
    CHECK (h.position() == steps + 1);
    CHECK (h.names().back() == "morph from snapshot 1 to 2");
    CHECK (readGraph (writeGraph (h.graph())).messages.empty());
    for (const double at : { 0.0, 0.25, 1.0 })
    {
        auto c = *std::ranges::find (h.graph().controls, made.control, &graph::Control::id);
        c.value = at;
        mustPerform (h, graph::ChangeControl { c.id, c });
        CHECK (valueIn (h.graph(), "wall", "stiffness") == Approx (1000.0 + 2000.0 * at));
    }
    while (h.position() > steps)
        h.undo();
    CHECK (writeGraph (h.graph()) == before);
}

TEST_CASE ("a morph says what it cannot move, and needs two snapshots that differ", "[snapshots]")
{
    graph::History h (loud (1.0));
    const auto refused = morphBetween (h.graph(), 1, 2, catalogue());
    REQUIRE_FALSE (refused);
    CHECK (refused.error().id == "morph/empty");
    mustPerform (h, storeSnapshot (h.graph(), 1));
    mustPerform (h, storeSnapshot (h.graph(), 2));
    CHECK (morphBetween (h.graph(), 1, 2, catalogue()).error().id == "morph/same");
    mustPerform (h, graph::SetParam { "", "a", "value", Json (2.0) });
    mustPerform (h, storeSnapshot (h.graph(), 2));
    mustPerform (h, morphBetween (h.graph(), 1, 2, catalogue())->command);
    mustPerform (h, storeSnapshot (h.graph(), 3));
    const auto again = morphBetween (h.graph(), 1, 2, catalogue());   // it takes the place of the first one
    REQUIRE (again);
    CHECK (again->replaced == std::vector<std::string> { "Morph 1-2" });
}

TEST_CASE ("a morph leaves switches as they are, so that a click on a mute moves nothing else", "[snapshots]")
{
    tactus::test::Sketch s;
    s.node ("desk", "layer.mix", Json::object(), { { "inputs", 3 } });
    graph::History h (s.graph);
    mustPerform (h, storeSnapshot (h.graph(), 1));
    mustPerform (h, graph::SetParam { "", "desk", "gain", Json::array ({ 1.0, 0.5, 1.0 }) });
    mustPerform (h, graph::SetParam { "", "desk", "mute", Json::array ({ 0.0, 0.0, 1.0 }) });
    mustPerform (h, graph::SetParam { "", "desk", "solo", Json::array ({ 0.0, 1.0, 0.0 }) });
    mustPerform (h, storeSnapshot (h.graph(), 2));
    const auto made = morphBetween (h.graph(), 1, 2, catalogue());
    REQUIRE (made);
    CHECK (made->params == 1);
    CHECK (made->left_out == 2);
    mustPerform (h, made->command);
    CHECK (controlOf (h.graph(), "desk.gain[1]"));
    CHECK_FALSE (controlOf (h.graph(), "desk.mute[2]"));
    CHECK_FALSE (controlOf (h.graph(), "desk.solo[1]"));
}

TEST_CASE ("a morph moves what knobs have set, takes their place, and follows the keys of its snapshots", "[snapshots]")
{
    auto g = loud (1.0);
    graph::Control knob;
    knob.id = knob.name = "push";
    knob.value = 0.25;
    knob.to = { { "a.value", 0.0, "4 N" } };
    g.controls.push_back (knob);
    graph::History h (g);
    knob.value = 0.75;
    auto other_knob = knob;
    other_knob.value = 0.5;
    mustPerform (h, graph::ChangeControl { "push", other_knob });
    mustPerform (h, storeSnapshot (h.graph(), 3));
    mustPerform (h, graph::ChangeControl { "push", g.controls[0] });
    const auto [made, before] = morphOver (h, graph::ChangeControl { "push", knob });
    CHECK (made.replaced == std::vector<std::string> { "push" });
    auto other = h.graph();
    other.controls[0].id = other.controls[0].name = "late";
    CHECK (laterControls (other, 1) == std::vector<std::string> { "late" });
    mustPerform (h, made.command);
    REQUIRE (h.graph().controls.size() == 1);
    const auto now = [&] { return controlOf (h.graph(), "a.value")->value; };
    CHECK (now() == Approx (1.0));
    mustPerform (h, *recallSnapshot (h.graph(), 2));
    CHECK (h.graph().controls[0].value == 1.0);
    CHECK (now() == Approx (3.0));
    CHECK (isAtSnapshot (h.graph(), 2));
    CHECK (laterControls (h.graph(), 2).empty());
    mustPerform (h, *recallSnapshot (h.graph(), 1));
    CHECK (now() == Approx (1.0));
    CHECK (readGraph (writeGraph (h.graph())).messages.empty());
    mustPerform (h, removeControl (h.graph(), made.control, catalogue()));
    for (const auto& [number, push] : { std::pair { 2, 3.0 }, std::pair { 3, 2.0 }, std::pair { 1, 1.0 } })
    {
        mustPerform (h, *recallSnapshot (h.graph(), number));
        CHECK (valueIn (h.graph(), "a", "value") == Approx (push));
    }
    for (int i = 0; i < 7; ++i)
        h.undo();
    CHECK (writeGraph (h.graph()) == before);
}

TEST_CASE ("what a control sets counts as no difference of its own", "[snapshots]")
{
    graph::History h (loadGraph (TACTUS_SOURCE_DIR "/graphs/velvet.json").graph);
    const auto turn = [&] (double to) {
        const auto controls = h.graph().controls;
        for (auto c : controls)
        {
            c.value = to;
            mustPerform (h, graph::ChangeControl { c.id, c });
        }
    };
    for (const auto& [number, value] : { std::pair { 1, 0.25 }, std::pair { 2, 0.75 } })
    {
        turn (value);
        mustPerform (h, storeSnapshot (h.graph(), number));
    }
    const auto made = morphBetween (h.graph(), 1, 2, catalogue());
    REQUIRE (made);
    CHECK (made->replaced.size() == 2);
    CHECK (made->left_out == 0);
    mustPerform (h, made->command);
    turn (0.5);
    mustPerform (h, storeSnapshot (h.graph(), 3));
    const auto next = morphBetween (h.graph(), 2, 3, catalogue());
    REQUIRE (next);
    CHECK (next->params == made->params);
    CHECK (next->left_out == 0);
}

TEST_CASE ("a control that is removed leaves each snapshot with the values that it held by it", "[snapshots]")
{
    auto g = loud (1.0);
    graph::Control knob;
    knob.id = "push";
    knob.to = { { "a.value", 0.0, "4 N" } };
    g.controls.push_back (knob);
    graph::History h (g);
    for (const auto& [number, value] : { std::pair { 1, 0.25 }, std::pair { 2, 0.75 } })
    {
        knob.value = value;
        mustPerform (h, graph::ChangeControl { "push", knob });
        mustPerform (h, storeSnapshot (h.graph(), number));
    }
    mustPerform (h, removeControl (h.graph(), "push", catalogue()));
    CHECK (valueIn (h.graph(), "a", "value") == Approx (3.0));
    mustPerform (h, *recallSnapshot (h.graph(), 1));
    CHECK (valueIn (h.graph(), "a", "value") == Approx (1.0));
    CHECK (isAtSnapshot (h.graph(), 1));
    mustPerform (h, *recallSnapshot (h.graph(), 2));
    CHECK (valueIn (h.graph(), "a", "value") == Approx (3.0));
}

TEST_CASE ("a recalled snapshot blends in without a step of the force", "[snapshots]")
{
    graph::History h (loud (1.0));
    mustPerform (h, storeSnapshot (h.graph(), 1));
    mustPerform (h, graph::SetParam { "", "a", "value", Json (3.0) });
    auto first = compile (h.graph(), catalogue());
    REQUIRE (first.plan);
    Engine engine (first.plan);
    Tip tip;
    engine.attach ("stylus", tip);
    for (int i = 0; i < 400; ++i)
        engine.tick();
    CHECK (tip.force == 3.0);
    mustPerform (h, *recallSnapshot (h.graph(), 1));
    auto next = compile (h.graph(), catalogue(), { .before = first.plan.get() });
    REQUIRE (next.plan);
    engine.submit (next.plan);
    double before = tip.force, largest = 0.0;
    for (int i = 0; i < 400; ++i)
    {
        engine.tick();
        largest = std::max (largest, std::abs (tip.force - before));
        before = tip.force;
    }
    CHECK (tip.force == Approx (1.0));
    CHECK (largest < 0.1);   // N, of 2 N
}

TEST_CASE ("random values stay within the usual ranges, leave out what is set elsewhere, and follow the seed", "[snapshots]")
{
    for (const char* preset : { "dry_wood", "granite_wall", "bronze_bell", "two_fingers" })
    {
        INFO (preset);
        const auto g = loadGraph (TACTUS_SOURCE_DIR "/graphs/" + std::string (preset) + ".json").graph;
        std::vector<graph::Id> all;
        for (const auto& n : g.root.nodes)
            all.push_back (n.id);
        std::set<std::string> different;
        for (std::uint64_t seed = 1; seed <= 20; ++seed)
        {
            const auto batch = randomised (g, {}, all, catalogue(), seed);
            graph::History h (g);
            REQUIRE_FALSE (batch.commands.empty());
            mustPerform (h, batch);
            CHECK (h.names().back() == "randomise, seed " + std::to_string (seed));
            const auto text = writeGraph (h.graph());
            different.insert (text);
            CHECK (readGraph (text).messages.empty());
            for (const auto& n : h.graph().root.nodes)
                for (const auto& [key, value] : n.params.items())
                    if (const auto* was = g.root.find (n.name); ! was->params.contains (key) || *was->params.find (key) != value)
                    {
                        const auto& rows = catalogue().find (n.type)->params;
                        const auto& sheet = *std::ranges::find (rows, key, &PortSheet::id);
                        for (std::size_t i = 0; i < (value.is_array() ? value.size() : 1); ++i)
                        {
                            INFO (n.name << "." << key << " " << value.dump());
                            const double si = siOf (value.is_array() ? value[i] : value, sheet);
                            CHECK (si >= sheet.limits.usual.min * (1.0 - 1e-9) - 1e-12);
                            CHECK (si <= sheet.limits.usual.max * (1.0 + 1e-9) + 1e-12);
                        }
                        CHECK (key != "offset");   // a wall would jump into the hand
                        for (const auto& c : g.controls)
                            for (const auto& t : c.to)
                                CHECK (t.path != n.name + "." + key);
                    }
            graph::History again (g);
            mustPerform (again, randomised (g, {}, all, catalogue(), seed));
            CHECK (writeGraph (again.graph()) == text);
        }
        CHECK (different.size() == 20);
    }
}

namespace
{
/// Dry wood with Bronze bell added.
graph::Graph withBell()
{
    auto open = loadGraph (TACTUS_SOURCE_DIR "/graphs/dry_wood.json").graph;
    const auto added = loadGraph (TACTUS_SOURCE_DIR "/graphs/bronze_bell.json").graph;
    auto made = compose::addPreset (open, added, { .roles = compose::roleMaps (open, added).front(), .parts = {}, .at = {} }, catalogue());
    REQUIRE (made);
    REQUIRE (graph::apply (open, made->command));
    return open;
}
}   // namespace

TEST_CASE ("random values reach what is inside of an added preset, but not what its knobs set, nor its levels", "[snapshots]")
{
    const auto g = withBell();
    std::vector<graph::Id> all;
    for (const auto& n : g.root.nodes)
        all.push_back (n.id);
    graph::History h (g);
    mustPerform (h, randomised (g, {}, all, catalogue(), 7));
    int changed = 0;
    for (const auto& [name, patch] : g.graphs)
        for (const auto& n : patch.nodes)
        {
            const auto& now = h.graph().find (name)->find (n.name)->params;
            changed += now != n.params ? 1 : 0;
            if (mixing::isMixer (n.type)) CHECK (now == n.params);
        }
    CHECK (changed > 0);
    for (const auto& c : g.controls)
        for (const auto& t : c.to)
        {
            const auto slash = t.path.rfind ('/'), dot = t.path.rfind ('.');
            if (slash == t.path.npos) continue;
            for (const auto& [name, patch] : g.graphs)
                if (const auto* n = patch.find (t.path.substr (slash + 1, dot - slash - 1)))
                {
                    const auto param = t.path.substr (dot + 1);
                    CHECK (h.graph().find (name)->find (n->name)->params.value (param, Json()) == n->params.value (param, Json()));
                }
        }
}
