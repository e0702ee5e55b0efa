// SPDX-License-Identifier: MIT
// State that survives in sections with their own rate when a plan takes over from another one.

#include "support/sketch.hpp"

#include "support/live.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace tactus;
using graph::SetNodeKey;
using test::Sketch;

namespace
{
/// A section `sec` under edits: its contents and exposed ports.
struct Bench
{
    Bench (const Sketch& s, std::vector<std::string> feeds, std::vector<std::string> records)
        : Bench (s, CompileOptions { .feeds = std::move (feeds), .records = std::move (records) })
    {
    }
    Bench (const Sketch& s, const CompileOptions& options) : live (s.graph, catalogue(), options, s.compile (options).plan) {}

    void tick (double fed = 0.0)
    {
        for (auto& feed : live.engine().plan().feeds())
            feed = fed;
        live.engine().tick();
    }

    void edit (graph::Command command)
    {
        const auto messages = live.perform (std::move (command));
        INFO (test::text (messages));
        REQUIRE_FALSE (hasErrors (messages));
    }

    /// Makes an edit outside the section.
    void touch()
    {
        edit (graph::AddNode { "", Sketch::makeNode ("idle" + std::to_string (idle++), "signal.abs") });
    }

    double value (std::size_t tap = 0) { return *live.engine().plan().taps().at (tap).value; }

    test::Live live;
    int idle = 0;
};

Sketch with (Json rate, const std::vector<graph::Node>& inside, const std::vector<std::string>& wires,
             const std::vector<std::pair<std::string, std::string>>& inputs, const std::vector<std::pair<std::string, std::string>>& outputs)
{
    Sketch sketch;
    auto& part = sketch.subgraph ("part");
    part.nodes = inside;
    for (const auto& w : wires)
        sketch.add (part, w);
    for (const auto& [name, end] : inputs)
        part.expose.inputs.emplace_back (name, *graph::parseEndpoint (end));
    for (const auto& [name, end] : outputs)
        part.expose.outputs.emplace_back (name, *graph::parseEndpoint (end));
    sketch.node ("sec", "graph:part");
    sketch.graph.root.nodes.back().extra = std::move (rate);
    return sketch;
}

/// A section that passes its input on and counts its own ticks.
Sketch passing (const Json& rate)
{
    auto sketch =
        with (rate,
              { Sketch::makeNode ("amp", "signal.gain"), Sketch::makeNode ("one", "signal.constant", { { "value", 1.0 } }),
                Sketch::makeNode ("count", "signal.add") },
              { "one.out -> count.in[0]", "count.out -> [1] -> count.in[1]" }, { { "in", "amp.in" } }, { { "out", "amp.out" }, { "count", "count.out" } });
    return sketch.node ("after", "signal.gain").wire ("sec.out -> after.in").node ("counted", "signal.gain").wire ("sec.count -> counted.in");
}

/// Hits that pass through the section to a bar.
Sketch knocking (const Json& rate)
{
    return with (rate, { Sketch::makeNode ("amp", "signal.gain") }, {}, { { "in", "amp.in" } }, { { "out", "amp.out" } })
        .node ("bar", "vibration.modal")
        .wire ("sec.out -> bar.hit");
}
}   // namespace

TEST_CASE ("a section that runs only on some ticks keeps its phase and its outputs through any number of plans", "[live][rates]")
{
    Bench bench { passing ({ { "every", 4 } }), { "sec.in" }, { "after.out", "counted.out", "sec/count.out", "sec/amp.in", "sec/count.in[1]" } };
    for (int n = 0; n < 23; ++n)
    {
        if (n % 3 != 1) bench.touch();
        bench.tick (n);
        CHECK (bench.value (0) == n - n % 4);
        CHECK (bench.value (1) == n / 4 + 1);
        CHECK (bench.value (2) == n / 4 + 1);
        CHECK (bench.value (3) == n - n % 4);
        CHECK (bench.value (4) == n / 4);
    }
}

TEST_CASE ("sums in a section that runs only on some ticks survive an edit", "[live][rates]")
{
    auto sketch = with ({ { "every", 4 } }, { Sketch::makeNode ("one", "signal.constant", { { "value", 1.0 } }), Sketch::makeNode ("bar", "vibration.modal") },
                        { "one.out -> bar.hit", "one.out -> bar.hit" }, {}, {});
    for (auto& w : sketch.subgraph ("part").wires)
        w.gain = "1 m/s";
    Bench bench { sketch, {}, { "sec/bar.hit" } };
    bench.tick();
    bench.touch();
    bench.tick();
    CHECK (bench.value() == 2.0);

    SECTION ("but start from scratch after a bypass")
    {
        bench.edit (SetNodeKey { "", "sec", "bypass", Json (true) });
        bench.tick();
        bench.edit (SetNodeKey { "", "sec", "bypass", std::nullopt });
        bench.tick();
        CHECK (bench.value() == 0.0);
        bench.tick();
        CHECK (bench.value() == 2.0);
    }
}

TEST_CASE ("a straight line continues through an edit", "[live][rates]")
{
    Bench bench { passing ({ { "every", 4 }, { "hold", "linear" } }), { "sec.in" }, { "after.out" } };
    for (int n = 0; n < 40; ++n)
    {
        if (n % 5 != 1) bench.touch();
        bench.tick (0.5 * n);
        CHECK (bench.value() == 0.5 * std::max (n - 4, 0));
    }
}

TEST_CASE ("lines into a section that runs several times per tick continue through an edit", "[live][rates]")
{
    Bench bench { passing ({ { "times", 4 } }), { "sec.in" }, { "sec.out" } };
    for (int n = 0; n < 10; ++n)
    {
        if (n % 3 != 1) bench.touch();
        bench.tick (4.0 * n);
        const auto& tap = bench.live.engine().plan().taps()[0];
        for (int i = 0; i < 4; ++i)
            CHECK (tap.samples[i] == std::max (4.0 * (n - 1) + i + 1, 0.0));
    }
}

TEST_CASE ("a hit that waits for its section arrives exactly once, even if the graph is edited meanwhile", "[live][rates]")
{
    Bench bench { knocking ({ { "every", 4 } }), { "sec.in" }, { "bar.hit" } };
    double arrived = 0.0;
    for (int n = 0; n < 12; ++n)
    {
        bench.tick (n == 1 || n == 2 ? 1.0 : 0.0);
        arrived += bench.value();
        bench.touch();
    }
    CHECK (arrived == 2.0);

    SECTION ("even if the rate of the section changes")
    {
        bench.tick();
        bench.tick (3.0);
        CHECK (bench.value() == 0.0);
        bench.edit (SetNodeKey { "", "sec", "every", Json (5) });
        for (int n = 0; n < 12; ++n)
        {
            bench.tick();
            arrived += bench.value();
        }
        CHECK (arrived == 5.0);
    }
}

TEST_CASE ("a different rate is like a new setting: a node keeps ringing at the new rate, and nodes at the old rate are untouched", "[live][rates]")
{
    const Json modes = Json::array ({ { { "frequency", 50.0 }, { "decay", 5.0 }, { "amplitude", 1.0 } } });
    auto sketch = with ({ { "every", 2 } }, { Sketch::makeNode ("bar", "vibration.modal", Json::object(), { { "modes", modes } }) }, {},
                        { { "hit", "bar.hit" } }, { { "value", "bar.value" } });
    sketch.node ("other", "graph:part");
    sketch.graph.root.nodes.back().extra = { { "every", 2 } };
    sketch.node ("after", "signal.gain").wire ("sec.value -> after.in");
    Bench bench { sketch, { "sec.hit", "other.hit" }, { "sec/bar.value", "other/bar.value" } };
    const auto nodeOf = [&] (const std::string& path) {
        const auto& plan = bench.live.engine().plan();
        return plan.instances()[static_cast<std::size_t> (std::ranges::find (plan.flat().nodes, path, &plan::FlatNode::path) - plan.flat().nodes.begin())]
            .node.get();
    };

    for (int n = 0; n < 400; ++n)
        bench.tick (n == 0 ? 1.0 : 0.0);
    const auto *changed = nodeOf ("sec/bar"), *same = nodeOf ("other/bar");
    bench.edit (SetNodeKey { "", "sec", "every", Json (4) });
    double step = 0.0, loudest = 0.0, last = bench.value();
    for (int n = 0; n < 400; ++n)
    {
        bench.tick();
        step = std::max (step, std::abs (bench.value() - last));
        last = bench.value();
        loudest = std::max (loudest, std::abs (last));
    }
    CHECK (nodeOf ("sec/bar") != changed);
    CHECK (nodeOf ("other/bar") == same);
    CHECK (loudest > 0.3);
    CHECK (step < 2.0 * 3.1416 * 50.0 * 4.0 / 4000.0);

    const auto* four = nodeOf ("sec/bar");
    bench.edit (SetNodeKey { "", "sec", "hold", Json ("linear") });   // does not change the rate
    bench.tick();
    CHECK (nodeOf ("sec/bar") == four);
}

TEST_CASE ("a node that is moved into a section holds its outputs until the section runs", "[live][rates]")
{
    auto sketch = with (Json::object(), { Sketch::makeNode ("amp", "signal.gain") }, {}, { { "in", "amp.in" } }, { { "out", "amp.out" } });
    sketch.node ("after", "signal.gain").wire ("sec.out -> after.in");
    Bench bench { sketch, { "sec.in" }, { "after.out" } };
    for (int n = 0; n < 6; ++n)
        bench.tick (n);
    bench.edit (SetNodeKey { "", "sec", "every", Json (4) });
    for (int n = 6; n < 12; ++n)
    {
        bench.tick (n);
        CHECK (bench.value() == (n < 8 ? 5.0 : 8.0));
    }
}

TEST_CASE ("a change in a section that runs only on some ticks takes effect when it runs, without a step", "[live][rates]")
{
    auto sketch = with ({ { "every", 16 } }, { Sketch::makeNode ("motor", "device.force") }, {}, { { "force", "motor.force" } }, {});
    sketch.graph.graphs[0].second.nodes[0].role = "stylus";
    sketch.node ("push", "signal.constant", { { "value", "2 N" } });
    Bench bench { sketch, {}, {} };
    const auto applied = [&] { return bench.live.engine().plan().roles()[0].state->applied.force.x(); };
    for (int n = 0; n < 21; ++n)
        bench.tick();
    bench.edit (graph::AddWire { "", *graph::parseWire ("push.out -> sec.force.x") });
    double step = 0.0, last = applied();
    for (int n = 21; n < 500; ++n)
    {
        if (n < 31) bench.touch();   // an edit outside the section does not cancel the change
        bench.tick();
        if (n <= 32) CHECK (applied() == 0.0);
        step = std::max (step, std::abs (applied() - last));
        last = applied();
    }
    CHECK (last == 2.0);
    CHECK (step <= 2.0 * 3.14159266 / 800.0);
}
