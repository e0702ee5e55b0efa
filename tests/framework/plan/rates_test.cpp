// SPDX-License-Identifier: MIT
// Subgraphs that run on every k-th tick, or m times per tick.

#include "support/parted.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <utility>

using namespace tactus;
using namespace tactus::test;

namespace
{
/// Hits through a section: gains before and inside it, and a bar after it. A gain passes on any kind of value, so only the
/// bar's hit input shows that the wires carry hits.
Parted knocking (Json rate)
{
    Parted sketch { std::move (rate) };
    sketch.add (sketch.part(), "amp", "signal.gain")
        .node ("before", "signal.gain")
        .node ("bar", "vibration.modal")
        .wire ("before.out -> sec.in")
        .wire ("sec.out -> bar.hit");
    return sketch;
}

std::vector<double> randomSignal (int size)
{
    const auto value = rc::gen::map (rc::gen::inRange (-1000000, 1000000), [] (int i) { return 1e-3 * i; });
    return *rc::gen::container<std::vector<double>> (static_cast<std::size_t> (size), value);
}

std::vector<double> randomHits (int size)
{
    const auto hit = rc::gen::map (rc::gen::inRange (-6, 6), [] (int i) { return std::max (i, 0); });
    return *rc::gen::container<std::vector<double>> (static_cast<std::size_t> (size), hit);
}

/// Counts the ticks of the section it is in.
void addCounter (Sketch& sketch, graph::Patch& patch)
{
    sketch.add (patch, "one", "signal.constant", { { "value", 1.0 } })
        .add (patch, "count", "signal.add")
        .add (patch, "one.out -> count.in[0]")
        .add (patch, "count.out -> [1] -> count.in[1]");
}
}   // namespace

TEST_CASE ("`every k` runs on the inputs of every k-th tick, and holds its outputs", "[plan][rates][property]")
{
    property ("for any signal", [] {
        const int k = *rc::gen::inRange (2, 9);
        const auto in = randomSignal (40);
        PlanRun run { doubling (every (k)), { "sec.in" }, { "after.out", "sec/amp.in" } };
        for (std::size_t n = 0; n < in.size(); ++n)
        {
            const auto held = in[n - n % static_cast<std::size_t> (k)];
            RC_ASSERT (*run.tick ({ in[n] }).value == 2.0 * held);
            RC_ASSERT (*run.plan->taps()[1].value == held);
        }
    });
}

TEST_CASE ("`every k` prepares nodes for its own rate: a filter inside is that filter on every k-th sample", "[plan][rates][property]")
{
    property ("for any signal", [] {
        const int k = *rc::gen::inRange (2, 9);
        const auto in = randomSignal (60);
        Parted slow { every (k) };
        slow.add (slow.part(), "amp", "filter.butterworth2", { { "cutoff", 30.0 } });
        const auto plain = Sketch {}.node ("amp", "filter.butterworth2", { { "cutoff", 30.0 } });
        PlanRun run { slow, { "sec.in" }, { "sec.out" }, 1000.0 * k }, reference { plain, { "amp.in" }, { "amp.out" }, 1000.0 };
        for (std::size_t n = 0; n < in.size(); ++n)
        {
            const auto value = *run.tick ({ in[n] }).value;
            if (n % static_cast<std::size_t> (k) == 0) reference.tick ({ in[n] });
            RC_ASSERT (value == *reference.plan->taps()[0].value);
        }
    });
}

TEST_CASE ("`linear` is exact on ramps, delayed by k ticks", "[plan][rates][property]")
{
    property ("for any slope", [] {
        const int k = *rc::gen::inRange (2, 9);
        const double slope = 1e-3 * *rc::gen::inRange (-1000, 1000);
        PlanRun run { doubling (every (k, "linear")), { "sec.in" }, { "after.out" } };
        for (int n = 0; n < 40; ++n)
            RC_ASSERT (std::abs (*run.tick ({ slope * n }).value - 2.0 * slope * std::max (n - k, 0)) < 1e-12);
    });
}

TEST_CASE ("`linear` ends each line on the value itself", "[plan][rates][property]")
{
    property ("for any signal", [] {
        const int k = *rc::gen::inRange (2, 9);
        const auto in = randomSignal (40);
        PlanRun run { doubling (every (k, "linear")), { "sec.in" }, { "after.out" } };
        for (std::size_t n = 0; n < in.size(); ++n)
        {
            const auto late = static_cast<std::size_t> (k);
            const auto value = *run.tick ({ in[n] }).value;
            if (n % late == 0 && n >= late) RC_ASSERT (value == 2.0 * in[n - late]);
        }
    });
}

TEST_CASE ("states are held, even with linear hold", "[plan][rates]")
{
    Parted sketch { every (4, "linear"), { { "position", "drag.position" } }, { { "state", "drag.state" }, { "force", "drag.force" } } };
    sketch.add (sketch.part(), "drag", "friction.elasto_plastic")
        .node ("state", "signal.gain")
        .node ("force", "vector.length")
        .wire ("sec.state -> state.in")
        .wire ("sec.force -> force.in");
    PlanRun run { sketch, { "sec.position.x" }, { "state.out", "force.amount" } };
    int between = 0;
    double last = 0.0;
    for (int n = 0; n < 1000; ++n)
    {
        const double state = *run.tick ({ 1e-5 * n }).value;
        CHECK (state == std::floor (state));
        between += n % 4 != 0 && *run.plan->taps()[1].value != last;
        last = *run.plan->taps()[1].value;
    }
    CHECK (*run.plan->taps()[0].value == 2.0);
    CHECK (between > 10);
}

TEST_CASE ("each hit enters and leaves a section once, and none is lost", "[plan][rates][property]")
{
    property ("every k", [] {
        const int k = *rc::gen::inRange (2, 9);
        const auto hits = randomHits (5 * k);
        PlanRun run { knocking (every (k, *rc::gen::arbitrary<bool>() ? "linear" : "latch")), { "before.in" }, { "bar.hit" } };
        double waiting = 0.0;
        for (std::size_t n = 0; n < hits.size(); ++n)
        {
            waiting += hits[n];
            const double there = *run.tick ({ hits[n] }).value;
            RC_ASSERT (there == (n % static_cast<std::size_t> (k) == 0 ? std::exchange (waiting, 0.0) : 0.0));
        }
    });
    property ("times m", [] {
        const int m = *rc::gen::inRange (2, 9);
        PlanRun run { knocking (times (m)), { "before.in" }, { "bar.hit", "sec/amp.out" } };
        for (const double hit : randomHits (40))
        {
            RC_ASSERT (*run.tick ({ hit }).value == hit);
            const auto& inside = run.plan->taps()[1];
            RC_ASSERT (inside.per_tick == m);
            for (int i = 0; i < m; ++i)
                RC_ASSERT (inside.samples[i] == (i == 0 ? hit : 0.0));
        }
    });
    property ("several ticks of a section deliver one hit", [] {
        const int m = *rc::gen::inRange (2, 5), k = *rc::gen::inRange (2, 5);
        Parted sketch { times (m), Json::object(), Json::object() };
        sketch.subgraph ("inner");
        sketch.add (sketch.subgraph ("inner"), "amp", "signal.gain");
        sketch.expose ("inner", { { "in", "amp.in" } }, { { "out", "amp.out" } });
        auto inner = Sketch::makeNode ("sec", "graph:inner");
        inner.extra = every (k);
        sketch.part().nodes.push_back (inner);
        sketch.expose ("part", { { "in", "sec.in" } }, { { "out", "sec.out" } });
        sketch.node ("before", "signal.gain").node ("bar", "vibration.modal").wire ("before.out -> sec.in").wire ("sec.out -> bar.hit");
        PlanRun run { sketch, { "before.in" }, { "bar.hit" } };
        double in = 0.0, out = 0.0;
        for (const double hit : randomHits (20))
        {
            in += hit;
            out += *run.tick ({ hit }).value;
        }
        for (int n = 0; n < k; ++n)
            out += *run.tick ({ 0.0 }).value;
        RC_ASSERT (in == out);
    });
}

TEST_CASE ("a bar inside `times m` equals a bar at m times the rate, hit on the first of m samples", "[plan][rates][property]")
{
    property ("bit for bit", [] {
        const int m = *rc::gen::inRange (2, 7);
        const Json modes = Json::array (
            { { { "frequency", 180.0 }, { "decay", 20.0 }, { "amplitude", 0.5 } }, { { "frequency", 2900.0 }, { "decay", 90.0 }, { "amplitude", 0.2 } } });
        Parted sketch { times (m), { { "hit", "bar.hit" } }, { { "value", "bar.value" } } };
        sketch.add (sketch.part(), "bar", "vibration.modal", Json::object(), { { "modes", modes } });
        const auto plain = Sketch {}.node ("bar", "vibration.modal", Json::object(), { { "modes", modes } });
        PlanRun run { sketch, { "sec.hit" }, { "sec.value" }, 4000.0 }, reference { plain, { "bar.hit" }, { "bar.value" }, 4000.0 * m };
        auto hits = randomHits (60);
        hits[1] = 1.0;
        double loudest = 0.0;
        for (const double hit : hits)
        {
            const auto& tap = run.tick ({ hit });
            for (int i = 0; i < m; ++i)
            {
                const double expected = *reference.tick ({ i == 0 ? hit : 0.0 }).value;
                RC_ASSERT (tap.samples[i] == expected);
                loudest = std::max (loudest, std::abs (expected));
            }
            RC_ASSERT (*tap.value == tap.samples[m - 1]);
        }
        RC_ASSERT (loudest > 0.0);
    });
}

TEST_CASE ("signals enter `times m` as straight lines that end on the value of the tick, and the first line is level", "[plan][rates][property]")
{
    property ("for any signal", [] {
        const int m = *rc::gen::inRange (2, 7);
        const auto in = randomSignal (30);
        PlanRun run { doubling (times (m)), { "sec.in" }, { "sec.out", "after.out" } };
        for (std::size_t n = 0; n < in.size(); ++n)
        {
            const auto& tap = run.tick ({ in[n] });
            const double before = in[n > 0 ? n - 1 : 0];
            for (int i = 0; i < m; ++i)
                RC_ASSERT (std::abs (tap.samples[i] - 2.0 * (before + (in[n] - before) * (i + 1) / m)) < 1e-9);
            RC_ASSERT (tap.samples[m - 1] == 2.0 * in[n]);
            RC_ASSERT (*run.plan->taps()[1].value == 2.0 * in[n]);
        }
    });
}

TEST_CASE ("factors of nested sections multiply, for both kinds", "[plan][rates]")
{
    const auto [outer, inner, ticks, expected] = GENERATE (table<Json, Json, int, double> ({
        { every (2), every (3), 12, 2.0 },
        { times (2), times (3), 4, 24.0 },
        { times (4), every (2), 5, 10.0 },
        { every (2), times (3), 8, 12.0 },
        { every (5), every (2), 11, 2.0 },
    }));
    Parted sketch { outer, Json::object(), { { "n", "inner.n" } } };
    auto use = Sketch::makeNode ("inner", "graph:inner");
    use.extra = inner;
    sketch.subgraph ("inner");
    addCounter (sketch, sketch.subgraph ("inner"));
    sketch.expose ("inner", Json::object(), { { "n", "count.out" } });
    sketch.part().nodes.push_back (use);
    sketch.expose ("part", Json::object(), { { "n", "inner.n" } });
    PlanRun run { sketch, {}, { "sec.n" } };
    double counted = 0.0;
    for (int n = 0; n < ticks; ++n)
        counted = *run.tick().value;
    CHECK (counted == expected);
}

TEST_CASE ("a factor of 1 makes no section", "[plan][rates]")
{
    for (const auto& rate : { every (1), every (1, "linear"), times (1) })
    {
        PlanRun run { doubling (rate), { "sec.in" }, { "after.out", "sec.out" } };
        CHECK (*run.tick ({ 1.0 }).value == 2.0);
        CHECK (*run.tick ({ 2.0 }).value == 4.0);
        CHECK (run.plan->taps()[1].per_tick == 1);
        CHECK (run.plan->flat().sections.size() == 1);
        CHECK (run.messages.empty());
    }
}

TEST_CASE ("delays in a section count its own ticks, and are reported in ticks of the graph", "[plan][rates]")
{
    const auto delays = [] (Json rate, const std::string& inside, const std::string& outside) {
        PlanRun run { fromHandToMotor (std::move (rate), inside, outside), {}, {} };
        REQUIRE (run.plan->delays().size() == 1);
        return std::pair { run.plan->delays()[0].shortest, run.plan->delays()[0].longest };
    };
    using Ticks = std::pair<std::int64_t, std::int64_t>;
    CHECK (delays (Json::object(), "split.x -> late.in", "sec.out -> motor.force.x") == Ticks { 0, 0 });
    CHECK (delays (every (4), "split.x -> late.in", "sec.out -> motor.force.x") == Ticks { 0, 3 });
    CHECK (delays (every (4), "split.x -> [2] -> late.in", "sec.out -> motor.force.x") == Ticks { 8, 11 });
    CHECK (delays (every (4, "linear"), "split.x -> late.in", "sec.out -> motor.force.x") == Ticks { 4, 7 });
    CHECK (delays (every (4), "split.x -> late.in", "sec.out -> [2] -> motor.force.x") == Ticks { 2, 5 });
}

TEST_CASE ("a loop through a section is refused, with its chain and the reason", "[plan][rates]")
{
    Parted sketch { every (2), { { "a", "a.in" }, { "b", "b.in" } }, { { "x", "a.out" }, { "y", "b.out" } } };
    sketch.add (sketch.part(), "a", "signal.gain").add (sketch.part(), "b", "signal.gain").node ("between", "signal.gain").wire ("sec.x -> between.in");

    SECTION ("even if nothing inside connects its ends")
    {
        sketch.wire ("between.out -> sec.b");
        const auto messages = sketch.compile().messages;
        REQUIRE (has (messages, "graph/loop"));
        CHECK (messages[0].text.find ("between.out -> sec/b.in, then sec/a.out -> between.in; 'sec' runs as a whole") != std::string::npos);
        CHECK (messages[0].remedy.find ("between.out -> [1] -> sec/b.in") != std::string::npos);
    }
    SECTION ("a delay in ticks of the graph opens the loop")
    {
        sketch.wire ("between.out -> [1] -> sec.b");
        PlanRun run { sketch, { "sec.a" }, { "sec.y" } };
        run.tick ({ 1.0 });
        run.tick ({ 2.0 });
        CHECK (*run.tick ({ 3.0 }).value == 1.0);
    }
    SECTION ("directly from its output to its input")
    {
        sketch.wire ("sec.y -> sec.b");
        CHECK (has (sketch.compile().messages, "graph/loop"));
    }
    SECTION ("a delay inside does not help: outputs wait for the whole section")
    {
        sketch.add (sketch.part(), "late", "signal.delay").add (sketch.part(), "b.out -> late.in");
        sketch.expose ("part", { { "b", "b.in" } }, { { "x", "late.out" } });
        sketch.wire ("between.out -> sec.b");
        CHECK (has (sketch.compile().messages, "graph/loop"));
    }
}

TEST_CASE ("`times` that returns to the hand is refused, port by port", "[plan][rates]")
{
    Parted sketch { times (4), { { "hit", "bar.hit" } }, { { "value", "bar.value" } } };
    sketch.add (sketch.part(), "bar", "vibration.modal")
        .node ("wall", "deform.plane")
        .node ("hand", "device.position")
        .node ("mix", "signal.add")
        .node ("motor", "device.force");
    sketch.wire ("hand.position -> wall.position").wire ("wall.hit -> sec.hit").wire ("wall.force -> motor.force");
    const auto fine = sketch.compile();
    INFO (test::text (fine.messages));
    REQUIRE (fine.plan);
    CHECK (fine.messages.empty());

    SECTION ("through a node in between, no matter how much later")
    {
        sketch.wire ("sec.value -> mix.in[0]").wire ("mix.out -> [3] -> motor.force.z");
        const auto messages = sketch.compile().messages;
        REQUIRE (has (messages, "rate/to_the_hand"));
        const auto& m = *std::ranges::find (messages, "rate/to_the_hand", &Message::id);
        CHECK (m.text.find ("sec/bar.value -> mix.in[0], then mix.out -> motor.force.z") != std::string::npos);
        CHECK (m.where == "/nodes/sec/times");
        CHECK_FALSE (m.remedy.empty());
    }
    SECTION ("through a parameter")
    {
        sketch.wire ("sec.value -> (+) wall.offset");
        sketch.graph.root.wires.back().gain = "1 m/N";
        CHECK (has (sketch.compile().messages, "rate/to_the_hand"));
    }
    SECTION ("through a motor inside")
    {
        sketch.add (sketch.part(), "motor", "device.force");
        CHECK (has (sketch.compile().messages, "rate/to_the_hand"));
        sketch.part().nodes.back().bypass = true;
        CHECK_FALSE (has (sketch.compile().messages, "rate/to_the_hand"));
    }
    SECTION ("within a section of the other kind")
    {
        auto& outer = sketch.subgraph ("outer");
        auto use = Sketch::makeNode ("fast", "graph:part");
        use.extra = times (4);
        outer.nodes.push_back (use);
        sketch.expose ("outer", { { "hit", "fast.hit" } }, { { "value", "fast.value" } });
        sketch.use ("slow", "outer", every (2)).wire ("slow.value -> motor.force.z");
        const auto messages = sketch.compile().messages;
        REQUIRE (has (messages, "rate/to_the_hand"));
        CHECK (std::ranges::find (messages, "rate/to_the_hand", &Message::id)->where == "/graphs/outer/nodes/fast/times");
    }
}

TEST_CASE ("mistakes with rates are reported, each with its own id and place", "[plan][rates]")
{
    const auto problem = [] (Json rate) { return doubling (std::move (rate)).compile().messages; };
    const auto is = [] (const Messages& messages, std::string_view id, std::string_view where) {
        if (messages.size() != 1) return false;
        return messages[0].id == id && messages[0].where == where && ! messages[0].remedy.empty();
    };

    CHECK (is (problem ({ { "every", 0 } }), "rate/value", "/nodes/sec/every"));
    CHECK (is (problem ({ { "every", 2.5 } }), "rate/value", "/nodes/sec/every"));
    CHECK (is (problem ({ { "times", "two" } }), "rate/value", "/nodes/sec/times"));
    CHECK (is (problem (every (2, "slow")), "rate/value", "/nodes/sec/hold"));
    CHECK (is (problem (every (5000)), "rate/value", "/nodes/sec/every"));   // below 1 Hz
    CHECK (is (problem (times (500)), "rate/value", "/nodes/sec/times"));    // above 1 MHz
    CHECK (is (problem ({ { "every", 2 }, { "times", 2 } }), "rate/both", "/nodes/sec/times"));
    CHECK (is (problem ({ { "hold", "linear" } }), "rate/hold_alone", "/nodes/sec/hold"));

    auto plain = Sketch {}.node ("amp", "signal.gain");
    plain.graph.root.nodes[0].extra = every (2);
    CHECK (is (plain.compile().messages, "rate/no_subgraph", "/nodes/amp/every"));
}

TEST_CASE ("a node's own warning refers to the rate at which the node runs", "[plan][rates]")
{
    const auto knock = [] (Json rate) {
        Parted sketch { std::move (rate), { { "hit", "knock.hit" } }, Json::object() };
        sketch.add (sketch.part(), "knock", "shock.hunt_crossley");
        return sketch.compile().messages;
    };
    CHECK (knock (Json::object()).empty());
    CHECK (has (knock (every (8)), "node/warning"));
}

TEST_CASE ("a tap in a `times` section has all samples of the tick, or at a different rate, those at the ends of equal parts of the tick", "[plan][rates]")
{
    PlanRun run { doubling (times (4)), { "sec.in" }, { "sec.out", "after.out" } };
    run.tick ({ 0.0 });
    const auto& tap = run.tick ({ 2.0 });
    const auto& plain = run.plan->taps()[1];
    CHECK (std::vector (tap.samples, tap.samples + 4) == std::vector { 1.0, 2.0, 3.0, 4.0 });
    CHECK (tap.sample (2, 4) == 3.0);
    CHECK (tap.sample (0, 2) == 2.0);
    CHECK (tap.sample (0, 1) == 4.0);
    CHECK (tap.sample (0, 8) == 1.0);
    CHECK (tap.sample (7, 8) == 4.0);
    CHECK (plain.per_tick == 1);
    CHECK (plain.sample (1, 4) == 4.0);
}
