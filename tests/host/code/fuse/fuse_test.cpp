// SPDX-License-Identifier: MIT
// Fused code is compared with the records of a second plan of the same graph, bit for bit, while parameters move, inputs are hit, and the
// first plan changes between its records and the fused code every few ticks.

#include "fused_plans.hpp"

#include <host/base/assets/file_assets.hpp>
#include <host/code/fuse/bitcode.hpp>
#include <support/interpreter.hpp>
#include <support/random_graph.hpp>
#include <support/sketch.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/kit/geometry/nearest_by_boxes.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/run/run.hpp>

#include <host/code/generate/exported_code.hpp>

#include <catch2/catch.hpp>

#include <cstring>
#include <random>

using namespace tactus;

namespace
{
namespace fs = std::filesystem;

/// Two runs of a graph with the same inputs. The first is fused.
class Twins
{
public:
    Twins (graph::Graph g, CompileOptions options, const Run::OpenDevice& open)
        : graph (std::move (g)), fused (catalogue(), options, open), planned (catalogue(), options, open)
    {
        for (auto* run : { &fused, &planned })
        {
            const auto messages = run->load (graph);
            INFO (test::text (messages));
            REQUIRE (run->hasEngine());
            Messages more;
            run->openDevices (graph, more);
        }
    }

    Plan& plan() { return fused.engine().plan(); }

    /// Ticks both, and returns how many values differ.
    int run (const std::shared_ptr<const FusedTick>& code, int ticks)
    {
        int differ = 0;
        for (int k = 0; k < ticks; ++k)
        {
            if (k % 3 == 0) plan().fuse (k % 6 == 0 ? code : nullptr);
            if (k % 50 == 0) disturb();
            if (k % 97 == 0)
                for (auto* run : { &fused, &planned })
                    run->engine().rearm();
            fused.tick();
            planned.tick();
            differ += difference();
        }
        return differ;
    }

    std::size_t valueCount() const { return values; }

private:
    static bool isSame (const double& a, const double& b) { return std::memcmp (&a, &b, sizeof a) == 0; }

    int difference()
    {
        int differ = 0;
        const auto &a = fused.engine().plan(), &b = planned.engine().plan();
        for (std::size_t t = 0; t < a.taps().size(); ++t)
            for (int k = 0; k < a.taps()[t].per_tick; ++k, ++values)
                if (! isSame (a.taps()[t].sample (k, a.taps()[t].per_tick), b.taps()[t].sample (k, b.taps()[t].per_tick))) ++differ;
        for (std::size_t r = 0; r < a.roles().size(); ++r)
            for (std::size_t s = 0; s < a.roles()[r].sinks.size(); ++s)
            {
                const auto &x = a.roles()[r].sinks[s], &y = b.roles()[r].sinks[s];
                const auto ex = x.effort (x.node), ey = y.effort (y.node);
                for (int c = 0; c < 3; ++c, values += 2)
                    differ += (isSame (ex.force[c], ey.force[c]) ? 0 : 1) + (isSame (ex.torque[c], ey.torque[c]) ? 0 : 1);
            }
        return differ;
    }

    /// Moves some parameters and hits some inputs, in both runs alike.
    void disturb()
    {
        auto& a = fused.engine().plan();
        for (std::size_t i = 0; i < a.instances().size(); ++i)
        {
            const auto &knobs = a.instances()[i].knobs, &others = planned.engine().plan().instances()[i].knobs;
            if (! knobs) continue;
            for (std::size_t k = 0; k < knobs->all.size(); ++k)
            {
                const auto* sheet = sheetOf (knobs->type, k);
                if (random() % 4 != 0 || sheet == nullptr) continue;
                const double to = sheet->choices.empty() ? knobs->all[k].value * (0.7 + 0.6 * static_cast<double> (random() % 1000) / 1000.0)
                                                         : static_cast<double> (random() % sheet->choices.size());
                fused.engine().set ({ knobs, k, sheet }, to);
                planned.engine().set ({ others, k, sheet }, to);
            }
            for (std::size_t h = 0; h < knobs->pulses.size(); ++h)
            {
                if (random() % 3 != 0) continue;
                const double speed = 0.1 + static_cast<double> (random() % 10) / 10.0;
                fused.engine().strike ({ knobs, h }, speed);
                planned.engine().strike ({ others, h }, speed);
            }
        }
    }

    static const PortSheet* sheetOf (const NodeType& type, std::size_t knob)
    {
        for (const auto& row : type.params)
        {
            if (knob < plan::Knobs::roomOf (row)) return &row;
            knob -= plan::Knobs::roomOf (row);
        }
        return nullptr;
    }

    graph::Graph graph;
    Run fused, planned;
    std::mt19937 random { 1 };
    std::size_t values = 0;
};

/// Records every output, or only some: a value that nothing outside reads need not be in memory.
std::unique_ptr<Twins> randomTwins (unsigned seed, bool records_all)
{
    const auto graph = test::randomGraph (seed, 14);
    CompileOptions options;
    for (const auto& [name, value] : test::Interpreter { graph, graph.rate_hz }.outputs())
        options.records.push_back (name);
    if (! records_all) options.records.resize ((options.records.size() + 4) / 5);
    return std::make_unique<Twins> (graph, options, test::randomHands (seed));
}

/// Contacts as instances of a subgraph. Their gains are two outputs of one node, which fused code keeps in registers unless something else reads
/// them.
std::unique_ptr<Twins> contactTwins()
{
    test::Sketch s;
    auto& part = s.subgraph ("contact");
    s.add (part, "board", "deform.plane", { { "offset", 1e-3 }, { "damping", 1.0 } }).add (part, "drag", "friction.elasto_plastic");
    s.add (part, "board.resistance -> drag.normal_force").add (part, "touch", "contact.window").add (part, "board.depth -> touch.depth");
    s.add (part, "grain", "texture.grating").add (part, "felt", "vector.scale").add (part, "grain.force -> felt.in");
    s.node ("c", "graph:contact");
    s.graph.root.nodes.front().extra["count"] = 2;
    for (const std::string axis : { "x", "y", "z" })
        s.node (axis, "signal.lfo", { { "frequency", 30.0 + axis.front() }, { "amplitude", 2e-3 } }).node ("gain_" + axis, "signal.lfo");
    s.node ("hand", "vector.join").node ("gains", "vector.join").node ("parts", "vector.split").wire ("gains.out -> parts.in");
    for (const std::string axis : { "x", "y", "z" })
        s.wire (axis + ".out -> hand." + axis).wire ("gain_" + axis + ".out -> gains." + axis);
    for (const std::string k : { "c[0]/", "c[1]/" })
        for (const auto* node : { "board", "drag", "grain" })
            s.wire ("hand.out -> " + k + node + ".position");
    s.wire ("parts.x -> c[0]/felt.gain").wire ("parts.y -> c[1]/felt.gain");
    CompileOptions options;
    for (const auto* output : { "board.force", "drag.force", "drag.state", "touch.gain", "felt.out" })
        for (const std::string k : { "c[0]/", "c[1]/" })
            options.records.push_back (k + output);
    return std::make_unique<Twins> (s.graph, options, Run::OpenDevice {});
}

class PresetTwins
{
public:
    Twins& add (const std::string& name)
    {
        const auto folder = fs::path (TACTUS_SOURCE_DIR) / "graphs";
        const auto open = [folder] (const std::string& role, const graph::Graph& graph, const Plan&, Messages&) -> Run::RoleDevice {
            auto made = makeDevice (*graph.device (role), folder);
            return { std::move (made.device), made.limits };
        };
        const CompileOptions options { .assets = &assets, .services = { .nearest_triangle = nearestByBoxes } };
        return *all.emplace_back (std::make_unique<Twins> (loadGraph (folder / (name + ".json")).graph, options, open));
    }

private:
    host::FileAssets assets;
    std::vector<std::unique_ptr<Twins>> all;
};

/// Compiles all of them together, and requires that nothing differs.
void requireSameBits (const std::vector<std::pair<std::string, Twins*>>& all, int ticks)
{
    test::FusedPlans plans;
    for (const auto& [name, twins] : all)
        plans.add (twins->plan());
    const auto codes = plans.load();
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        INFO (all[i].first);
        CHECK (all[i].second->run (codes[i], ticks) == 0);
        CHECK (all[i].second->valueCount() > 0);
    }
}

/// The same for what LLVM makes.
void requireSameBitsByLlvm (const std::string& name, Twins& twins, int ticks)
{
    INFO (name);
    const auto code = test::fusedByLlvm (twins.plan());
    REQUIRE (code);
    CHECK (twins.run (code, ticks) == 0);
    CHECK (twins.valueCount() > 0);
}
}   // namespace

TEST_CASE ("fused code gives the bits of the plan while they take turns and parameters move", "[fuse]")
{
    // Six swaps in 18 ticks: more than 1000 in each graph. Subgraphs, sections at other rates, delays, driven parameters, bypassed nodes.
    std::vector<std::unique_ptr<Twins>> random;
    std::vector<std::pair<std::string, Twins*>> all;
    for (unsigned seed = 1; seed <= 12; ++seed)
    {
        random.push_back (randomTwins (seed, seed % 2 == 0));
        all.emplace_back ("random graph " + std::to_string (seed), random.back().get());
    }
    const auto contacts = contactTwins();
    all.emplace_back ("contacts", contacts.get());
    PresetTwins presets;
    for (const auto* name : { "dry_wood", "vibraphone_bar" })
        all.emplace_back (name, &presets.add (name));
    requireSameBits (all, 3200);
}

TEST_CASE ("what LLVM makes gives the bits of the plan while they take turns and parameters move", "[fuse]")
{
    if (! test::hasLlvm())
    {
        WARN ("skipped: there is no LLVM, or no clang when this was built");
        return;
    }
    for (unsigned seed = 1; seed <= 24; ++seed)
    {
        const auto twins = randomTwins (seed, seed % 2 == 0);
        requireSameBitsByLlvm ("random graph " + std::to_string (seed), *twins, 3200);
    }
    requireSameBitsByLlvm ("contacts", *contactTwins(), 3200);
    PresetTwins presets;
    for (const auto* name : { "dry_wood", "vibraphone_bar" })
        requireSameBitsByLlvm (name, presets.add (name), 3200);
}

TEST_CASE ("every preset gives the same bits when LLVM has fused it", "[.][fuse_all]")
{
    if (! test::hasLlvm())
    {
        WARN ("skipped: there is no LLVM, or no clang when this was built");
        return;
    }
    PresetTwins presets;
    for (const auto& name : test::presetNames())
        requireSameBitsByLlvm (name, presets.add (name), 12000);
}

TEST_CASE ("the program contains the bitcode of every node, and LLVM can fuse and load each", "[.][fuse_all]")
{
    if (! test::hasLlvm())
    {
        WARN ("skipped: there is no LLVM, or no clang when this was built");
        return;
    }
    for (const auto& type : catalogue())
    {
        const std::string id (type.info.id);
        INFO (id);
        CHECK_FALSE (host::findBitcode (host::classOf (id).header).empty());
        const auto plan = test::Sketch {}.node ("node", id).compile().plan;
        if (plan == nullptr || plan->records().empty()) continue;   // a setting is missing, such as a recording
        CHECK (test::fusedByLlvm (*plan) != nullptr);
    }
}

TEST_CASE ("every preset gives the same bits fused", "[.][fuse_all]")
{
    PresetTwins presets;
    for (const auto& name : test::presetNames())
        requireSameBits ({ { name, &presets.add (name) } }, 12000);
}

TEST_CASE ("the code of each node type can be fused and loaded", "[.][fuse_all]")
{
    // Loading resolves all symbols, so it fails if a tick calls something that host/code/fuse/exports.list does not have.
    test::FusedPlans plans;
    std::size_t types = 0, fused = 0;
    for (const auto& type : catalogue())
    {
        ++types;
        const auto plan = test::Sketch {}.node ("node", std::string (type.info.id)).compile().plan;
        if (plan == nullptr || plan->records().empty()) continue;   // a setting is missing, such as a recording
        plans.add (*plan);
        ++fused;
    }
    CHECK (plans.load().size() == fused);
    CHECK (fused > types / 2);
}

TEST_CASE ("the fused code of a graph does not depend on where its plan is in memory", "[fuse]")
{
    const auto sketch = test::Sketch {}.node ("a", "filter.one_pole").node ("b", "filter.one_pole", { { "cutoff", 20.0 } }).wire ("a.out -> [1] -> b.in");
    const CompileOptions options { .feeds = { "a.in" }, .records = { "b.out" } };
    const auto first = sketch.compile (options).plan, second = sketch.compile (options).plan;
    CHECK (host::FusedCode::of (*first).text == host::FusedCode::of (*second).text);
    CHECK (host::FusedCode::of (*first).objects != host::FusedCode::of (*second).objects);
    CHECK (host::FusedCode::wiringOf (*first).text == host::FusedCode::wiringOf (*second).text);
}
