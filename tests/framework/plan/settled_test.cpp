// SPDX-License-Identifier: MIT
// Nodes whose inputs never change run only when a parameter was written, and all values are the same as if they ran on each tick.

#include "support/interpreter.hpp"
#include "support/random_edit.hpp"
#include "support/random_graph.hpp"
#include "support/sketch.hpp"

#include <support/property.hpp>
#include <tactus/graph/history.hpp>
#include <tactus/plan/find_param.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <random>

using namespace tactus;
using test::Sketch;

namespace
{
/// A plan that is ticked alone, and its successors.
struct Player
{
    bool settles;
    std::shared_ptr<Plan> plan {};

    /// False if the graph does not compile.
    bool follow (const graph::Graph& graph, CompileOptions options)
    {
        options.settles = settles;
        options.before = plan.get();
        auto next = compile (graph, catalogue(), options).plan;
        if (next == nullptr) return false;
        plan ? next->takeOver (*plan) : next->startRamping();
        plan = std::move (next);
        return true;
    }

    void turn (const std::string& name, double value)
    {
        const auto refs = plan::findParams (*plan, name);
        REQUIRE (refs);
        for (const auto& ref : *refs)
            plan::turn (ref, value);
    }

    void tick (std::uint64_t number)
    {
        plan->applyTurns (nullptr);
        plan->beginTick (number);
        plan->tick();
    }

    double value (std::size_t tap) const { return *plan->taps()[tap].value; }
};

/// The name of the first value that differs.
std::string difference (const Player& a, const Player& b)
{
    for (std::size_t t = 0; t < a.plan->taps().size(); ++t)
        if (std::bit_cast<std::uint64_t> (a.value (t)) != std::bit_cast<std::uint64_t> (b.value (t)))
            return a.plan->taps()[t].name + ": " + std::to_string (a.value (t)) + " on each tick, " + std::to_string (b.value (t)) + " if settled";
    return {};
}

/// "push" and "half" never change by themselves, nor does their sum; "hand" does.
Sketch constants()
{
    auto s = Sketch {}
                 .node ("push", "signal.constant", { { "value", 2.0 } })
                 .node ("half", "signal.gain", { { "gain", 0.5 } })
                 .node ("all", "signal.add", Json::object(), { { "inputs", 3 } })
                 .node ("hand", "signal.lfo", { { "frequency", 50.0 } })
                 .node ("both", "signal.add", Json::object(), { { "inputs", 3 } })
                 .wire ("push.out -> half.in")
                 .wire ("half.out -> all.in[0]")
                 .wire ("push.out -> all.in[1]")
                 .wire ("all.out -> both.in[0]")
                 .wire ("hand.out -> both.in[1]");
    s.graph.root.wires[2].gain = 3.0;
    return s;
}

std::size_t settledIn (const Sketch& s, CompileOptions options = {})
{
    options.settles = true;
    const auto [plan, messages] = s.compile (options);
    INFO (test::text (messages));
    REQUIRE (plan);
    return plan->settled().size();
}
}   // namespace

TEST_CASE ("nodes that never change are settled, and what changes is not", "[plan][settled]")
{
    CHECK (constants().compile().plan->settled().empty());
    CHECK (settledIn (constants()) == 4);   // push, half, the gain of a wire, all
    CHECK (settledIn (constants(), { .feeds = { "half.in" } }) == 1);
    CHECK (settledIn (constants().wire ("hand.out -> all.in[2]")) == 2);
    CHECK (settledIn (constants().wire ("hand.out -> half.gain")) == 1);
    CHECK (settledIn (constants().wire ("hand.out -> [1] -> half.gain")) == 1);
    CHECK (settledIn (constants().node ("late", "signal.abs").wire ("push.out -> [2] -> late.in")) == 4);
    CHECK (settledIn (constants().node ("slow", "filter.one_pole").wire ("push.out -> slow.in")) == 4);   // it has state
    auto bypassed = constants();
    bypassed.graph.root.nodes[1].bypass = true;
    CHECK (settledIn (bypassed) == 1);
}

TEST_CASE ("nodes in a section with its own rate are not settled", "[plan][settled]")
{
    auto s = constants();
    auto& part = s.subgraph ("part");
    s.add (part, "one", "signal.constant", { { "value", 1.0 } }).add (part, "twice", "signal.add").add (part, "one.out -> twice.in[0]");
    part.expose.outputs = { { "out", { "twice", "out" } } };
    s.node ("inner", "graph:part").node ("after", "signal.abs").wire ("inner.out -> after.in");
    CHECK (settledIn (s) == 7);
    for (const auto* rate : { "every", "times" })
    {
        auto rated = s;
        rated.graph.root.nodes[5].extra[rate] = 2;
        CHECK (settledIn (rated) == 4);
    }
}

TEST_CASE ("settled nodes run on the first tick and while a parameter moves, and only then", "[plan][settled]")
{
    const auto s = constants();
    Player each { false }, settled { true };
    const CompileOptions options { .rate_hz = 1000.0, .records = { "push.out", "half.out", "all.out", "both.out" } };
    REQUIRE (each.follow (s.graph, options));
    REQUIRE (settled.follow (s.graph, options));
    std::uint64_t now = 0;
    const auto differ = [&] (int ticks) {
        int count = 0;
        for (int k = 0; k < ticks; ++k, ++now)
        {
            each.tick (now);
            settled.tick (now);
            count += ! difference (each, settled).empty();
        }
        return count;
    };
    CHECK (differ (5) == 0);
    CHECK (settled.value (2) == 7.0);

    auto& out = *const_cast<double*> (settled.plan->taps()[1].value);
    out = 7.0;   // a node that does not run leaves the value as it is
    each.tick (now);
    settled.tick (now++);
    CHECK (out == 7.0);
    for (auto* player : { &each, &settled })
        player->turn ("push.value", 3.0);
    CHECK (differ (40) == 0);   // the ramp takes 20 ticks
    CHECK (settled.value (2) == 10.5);
    out = 7.0;
    settled.tick (now++);
    CHECK (out == 7.0);
}

TEST_CASE ("a settled value that is not finite becomes 0, and recovers", "[plan][settled]")
{
    auto s = constants();
    s.graph.root.nodes[1].params["gain"] = 1e300;
    s.graph.root.nodes[0].params["value"] = 1e300;
    Player settled { true };
    REQUIRE (settled.follow (s.graph, { .rate_hz = 1000.0, .records = { "push.out", "half.out" } }));
    settled.tick (0);
    CHECK (settled.value (0) == 1e300);
    CHECK (settled.value (1) == 0.0);
    settled.turn ("half.gain", 0.5);
    for (std::uint64_t k = 1; k < 40; ++k)
        settled.tick (k);
    CHECK (settled.value (1) == 5e299);
}

TEST_CASE ("an edit of a wire to a settled node makes it run on each tick", "[plan][settled]")
{
    graph::History history (constants().graph);
    Player each { false }, settled { true };
    const CompileOptions options { .records = { "half.out", "all.out", "both.out" } };
    const auto follow = [&] { return each.follow (history.graph(), options) && settled.follow (history.graph(), options); };
    int differ = 0;
    std::uint64_t now = 0;
    const auto play = [&] {
        for (int k = 0; k < 30; ++k, ++now)
        {
            each.tick (now);
            settled.tick (now);
            differ += ! difference (each, settled).empty();
        }
    };
    REQUIRE (follow());
    play();
    auto wire = *graph::parseWire ("hand.out -> all.in[2]");
    const auto id = wire.id;
    REQUIRE (history.perform (graph::AddWire { "", wire }));
    REQUIRE (follow());
    CHECK (settled.plan->settled().size() == 2);   // push, half
    play();
    REQUIRE (history.perform (graph::RemoveWire { "", id }));
    REQUIRE (follow());
    play();
    REQUIRE (history.perform (graph::AddWire { "", *graph::parseWire ("half.out -> both.in[2]") }));
    REQUIRE (follow());
    play();
    CHECK (differ == 0);
}

namespace
{
/// Plays a random graph while parameters move and wires, nodes and values are edited. Returns the first difference; empty if there is none.
/// No value if the graph does not compile.
std::optional<std::string> playRandomGraph (unsigned seed)
{
    std::mt19937 random { seed };
    const auto below = [&random] (std::size_t n) { return random() % n; };
    graph::History history (test::prefixed (test::randomGraph (seed, 2 + static_cast<int> (below (30))), "e_", "right"));
    Player each { false }, settled { true };
    std::string wrong;
    const auto follow = [&] {
        if (compile (history.graph(), catalogue()).plan == nullptr) return false;
        CompileOptions options { .rate_hz = 1000.0 };
        for (const auto& [name, value] : test::Interpreter { history.graph(), options.rate_hz }.outputs())
            options.records.push_back (name);
        if (each.follow (history.graph(), options) != settled.follow (history.graph(), options)) wrong = "only one of the two compiles";
        return true;
    };
    if (! follow()) return std::nullopt;
    for (std::uint64_t k = 0; k < 200 && wrong.empty(); ++k)
    {
        each.tick (k);
        settled.tick (k);
        if (const auto found = difference (each, settled); ! found.empty()) return "tick " + std::to_string (k) + ": " + found;
        if (below (10) == 0 && ! each.plan->instances().empty())
        {
            const auto i = below (each.plan->instances().size());
            const auto &a = each.plan->instances()[i].knobs, &b = settled.plan->instances()[i].knobs;
            if (a && ! a->all.empty() && ! plan::jumps (a->type, 0, 1.0, 2.0))
                for (const auto& knobs : { a, b })
                    plan::turn ({ knobs, 0, &knobs->type.params.front() }, 0.1 * static_cast<double> (k % 17));
        }
        if (below (15) != 0) continue;
        if (! history.perform (test::randomEdit (random, history.graph(), "e_", "right"))) continue;
        if (! follow()) history.undo();
    }
    return wrong;
}
}   // namespace

TEST_CASE ("settled nodes change no bit of random graphs", "[plan][settled][property]")
{
    CHECK (playRandomGraph (117623) == "");   // an edit overrides a choice
    test::property ("while parameters move and wires, nodes and values are edited", [] {
        const auto found = playRandomGraph (*rc::gen::arbitrary<unsigned>());
        if (! found) RC_DISCARD ("the graph does not compile");
        RC_LOG (*found);
        RC_ASSERT (found->empty());
    });
}
