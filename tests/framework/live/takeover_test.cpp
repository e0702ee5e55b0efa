// SPDX-License-Identifier: MIT
// State that survives when a plan takes over from another one, case by case.

#include "support/chance_hand.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;
using graph::SetNodeKey;
using graph::SetParam;
using graph::SetSetting;
using test::Sketch;

namespace
{
graph::Wire wire (const std::string& text) { return *graph::parseWire (text); }

/// A running graph that the tests edit, and the ports that it records.
struct Bench
{
    explicit Bench (const Sketch& s, std::vector<std::string> records = {}) : Bench (s, CompileOptions { .records = std::move (records) }) {}

    Bench (const Sketch& s, const CompileOptions& options) : live (s.graph, catalogue(), options, s.compile (options).plan) {}

    void tick (int n = 1)
    {
        for (int k = 0; k < n; ++k)
            live.engine().tick();
    }

    /// Carries out an edit that must compile.
    void edit (graph::Command command)
    {
        const auto messages = live.perform (std::move (command));
        INFO (test::text (messages));
        REQUIRE_FALSE (hasErrors (messages));
    }

    void edit (std::vector<graph::Command> commands) { edit (graph::Batch { "several", std::move (commands) }); }

    double value (std::size_t tap = 0) { return *live.engine().plan().taps().at (tap).value; }
    graph::Id wireId (std::size_t i) { return live.graph().root.wires.at (i).id; }

    test::Live live;
};

/// A number that rises by 1 per tick, counted by a loop through a delayed wire.
Sketch counting()
{
    return Sketch {}
        .node ("count", "signal.add")
        .node ("one", "signal.constant", { { "value", 1.0 } })
        .wire ("one.out -> count.in[0]")
        .wire ("count.out -> [1] -> count.in[1]");
}

/// A bar that is hit on the first tick.
Sketch struck()
{
    auto mode = [] (double f) { return Json { { "frequency", f }, { "decay", 5.0 }, { "amplitude", 1.0 } }; };
    return Sketch {}
        .node ("bar", "vibration.modal", Json::object(), { { "modes", Json::array ({ mode (100.0) }) } })
        .node ("motor", "device.force")
        .wire ("bar.value -> motor.force.x");
}

const Json two_modes =
    Json::array ({ { { "frequency", 100.0 }, { "decay", 5.0 }, { "amplitude", 1.0 } }, { { "frequency", 250.0 }, { "decay", 5.0 }, { "amplitude", 1.0 } } });
}   // namespace

TEST_CASE ("values in transit on a delayed wire survive, even if the delay changes", "[live]")
{
    Bench bench { counting().node ("late", "signal.gain").wire ("count.out -> [4] -> late.in"), { "count.out", "late.out" } };
    bench.tick (10);
    CHECK (bench.value (1) == 6.0);

    SECTION ("if something else is edited")
    {
        bench.edit (graph::AddNode { "", Sketch::makeNode ("idle", "signal.abs") });
        bench.tick();
        CHECK (bench.value (0) == 11.0);
        CHECK (bench.value (1) == 7.0);
    }
    SECTION ("shorter: the newest values remain")
    {
        bench.edit (graph::ChangeWire { "", bench.wireId (2), wire ("count.out -> [2] -> late.in") });
        bench.tick();
        CHECK (bench.value (0) == 11.0);
        CHECK (bench.value (1) == 9.0);
    }
    SECTION ("longer: the oldest value is held until the next one arrives")
    {
        bench.edit (graph::ChangeWire { "", bench.wireId (2), wire ("count.out -> [6] -> late.in") });
        for (const double expected : { 7.0, 7.0, 7.0, 8.0, 9.0 })
        {
            bench.tick();
            CHECK (bench.value (1) == expected);
        }
    }
    SECTION ("a new wire starts empty")
    {
        bench.edit ({ graph::RemoveWire { "", bench.wireId (2) }, graph::AddWire { "", wire ("count.out -> [4] -> late.in") } });
        bench.tick();
        CHECK (bench.value (1) == 0.0);
    }
}

TEST_CASE ("adding a mode to a ringing bar does not click, and the bar keeps ringing", "[live]")
{
    const CompileOptions options { .feeds = { "bar.hit" }, .records = { "bar.value" } };
    Bench bench { struck(), options }, plain { struck(), options };
    double last = 0.0, step = 0.0;
    for (int k = 0; k < 400; ++k)
    {
        if (k == 200) bench.edit (SetSetting { "", "bar", "modes", two_modes });
        bench.live.engine().plan().feeds()[0] = plain.live.engine().plan().feeds()[0] = k == 3 ? 1.0 : 0.0;
        bench.tick();
        plain.tick();
        CHECK (bench.value() == Approx (plain.value()).margin (1e-12));   // the second mode is silent until the next hit
        if (k > 4) step = std::max (step, std::abs (bench.value() - last));
        last = bench.value();
    }
    CHECK (step < 2.0 * std::numbers::pi * 100.0 / 4000.0 * 1.01);
    CHECK (std::abs (plain.value()) > 1e-3);

    bench.edit (SetSetting { "", "bar", "modes", Json::array ({ two_modes[1] }) });
    bench.tick();
    CHECK (bench.live.engine().plan().feeds()[0] == 0.0);
}

TEST_CASE ("a setting with the same content is not a change, and the node continues untouched", "[live]")
{
    Bench bench { struck() };
    const auto* node = bench.live.engine().plan().instances()[0].node.get();
    bench.edit (SetSetting { "", "bar", "modes", Json::array ({ { { "frequency", "0.1 kHz" }, { "decay", 5 }, { "amplitude", 1 } } }) });
    bench.tick();
    CHECK (bench.live.engine().plan().instances()[0].node.get() == node);
    CHECK (bench.live.engine().plan().roles()[0].untouched);
    bench.edit (SetSetting { "", "bar", "modes", two_modes });
    bench.tick();
    CHECK (bench.live.engine().plan().instances()[0].node.get() != node);
    CHECK_FALSE (bench.live.engine().plan().roles()[0].untouched);
}

TEST_CASE ("a node whose type changes starts from scratch under its name, and keeps its wires", "[live]")
{
    Bench bench { counting().node ("tail", "signal.gain", { { "gain", 2.0 } }).wire ("count.out -> tail.in"), { "tail.out", "count.out" } };
    bench.tick (5);
    CHECK (bench.value() == 10.0);
    bench.edit ({ SetParam { "", "tail", "gain", std::nullopt }, SetNodeKey { "", "tail", "type", Json ("signal.abs") } });
    bench.tick();
    CHECK (bench.value() == 6.0);
    CHECK (bench.value (1) == 6.0);
}

TEST_CASE ("a node that was bypassed starts from scratch instead of resuming its old state", "[live]")
{
    auto sketch = Sketch {}
                      .node ("one", "signal.constant", { { "value", 1.0 } })
                      .node ("late", "signal.delay", Json::object(), { { "ticks", 3 } })
                      .wire ("one.out -> late.in");
    Bench bench { sketch, { "late.out" } };
    bench.tick (5);
    CHECK (bench.value() == 1.0);
    bench.edit (SetNodeKey { "", "late", "bypass", Json (true) });
    bench.tick();
    bench.edit (SetNodeKey { "", "late", "bypass", std::nullopt });
    bench.tick();
    CHECK (bench.value() == 0.0);
}

TEST_CASE ("the last sink of a role is removed and restored without a step", "[live]")
{
    auto sketch = Sketch {}
                      .node ("push", "signal.constant", { { "value", "2 N" } })
                      .node ("hand", "device.position")
                      .node ("motor", "device.force")
                      .wire ("push.out -> motor.force.x");
    Bench bench { sketch };
    test::ChanceHand hand { 1, 1000 };
    bench.live.engine().attach ("stylus", hand);
    bench.tick (10);
    CHECK (hand.last.force.x() == 2.0);

    const auto motor = *bench.live.graph().root.find ("motor");
    const auto push = bench.live.graph().root.wires[0];
    bench.edit ({ graph::RemoveNode { "", "motor" }, graph::RemoveNode { "", "hand" } });
    bench.tick();
    CHECK (hand.last.force.x() == Approx (2.0));
    bench.tick (20);
    CHECK (hand.last.force.x() == Approx (1.0));
    bench.tick (20);
    CHECK (hand.last.force.x() == 0.0);
    bench.edit (graph::AddNode { "", Sketch::makeNode ("idle", "signal.abs") });
    bench.tick (5);
    bench.edit ({ graph::AddNode { "", motor }, graph::AddWire { "", push } });
    bench.tick();
    CHECK (hand.last.force.x() == Approx (0.0).margin (1e-15));
    bench.tick (20);
    CHECK (hand.last.force.x() == Approx (0.0).margin (1e-15));   // new nodes settle first
    bench.tick (200);
    CHECK (hand.last.force.x() == Approx (1.0));   // what rises fades ten times as slowly
    bench.tick (200);
    CHECK (hand.last.force.x() == 2.0);

    double step = 0.0;
    for (std::size_t k = 11; k < hand.efforts.size(); ++k)
        step = std::max (step, (hand.efforts[k].force - hand.efforts[k - 1].force).norm());
    CHECK (step <= 2.0 * std::numbers::pi / 80.0);
}

TEST_CASE ("a second takeover during a fade starts a new fade from the current effort on the device", "[live]")
{
    auto sketch = Sketch {}.node ("push", "signal.constant", { { "value", "2 N" } }).node ("motor", "device.force").wire ("push.out -> motor.force.x");
    Bench bench { sketch };
    bench.tick();
    bench.edit (graph::RemoveWire { "", bench.wireId (0) });
    bench.tick (21);
    const auto applied = [&] { return bench.live.engine().plan().roles()[0].state->applied.force.x(); };
    CHECK (applied() == Approx (1.0));
    bench.live.undo();
    bench.tick();
    CHECK (applied() == Approx (1.0));
    bench.tick (200);
    CHECK (applied() == Approx (1.5));
    bench.live.engine().halt();
    bench.tick (25);
    CHECK (applied() == 0.0);
}

TEST_CASE ("an edit that does not compile is reported, and the previous plan keeps running", "[live]")
{
    Bench bench { counting(), { "count.out" } };
    bench.tick (3);
    auto messages = bench.live.perform (graph::AddWire { "", wire ("count.out -> one.value") });
    CHECK (test::has (messages, "graph/loop"));
    bench.tick();
    CHECK (bench.value() == 4.0);
    CHECK (bench.live.engine().clear() == 1);

    messages = bench.live.perform (graph::RemoveNode { "", "missing" });
    REQUIRE (messages.size() == 1);
    CHECK (messages[0].id == "edit/unknown_node");
    CHECK (bench.live.graph().root.wires.size() == 3);

    CHECK_FALSE (hasErrors (bench.live.undo()));
    bench.tick();
    CHECK (bench.value() == 5.0);
}

TEST_CASE ("a valid plan that no tick has picked up yet survives an edit that does not compile", "[live]")
{
    Bench bench { counting(), { "count.out" } };
    bench.tick (3);
    bench.edit (graph::SetNodeKey { "", "one", "bypass", Json (true) });
    CHECK (hasErrors (bench.live.perform (graph::AddWire { "", wire ("count.out -> count.in[0]") })));
    bench.tick (3);
    CHECK (bench.value() == 3.0);
}

TEST_CASE ("a changed rate applies at the next start, with a warning", "[live]")
{
    Bench bench { counting(), { "count.out" } };
    bench.tick (3);
    CHECK (test::has (bench.live.perform (graph::SetHeader { .rate_hz = 1000.0 }), "watch/rate"));
    bench.tick();
    CHECK (bench.value() == 4.0);
    CHECK (bench.live.engine().plan().rateHz() == 4000.0);
    CHECK (bench.live.undo().empty());

    auto slow = bench.live.graph();
    slow.rate_hz = 1000.0;
    CHECK_THROWS_AS (bench.live.engine().submit (compile (slow, catalogue()).plan), std::invalid_argument);
}

TEST_CASE ("unused plans are freed, and never more than three are kept", "[live]")
{
    Bench bench { counting() };
    std::vector<std::weak_ptr<Plan>> plans;
    for (int i = 0; i < 50; ++i)
    {
        bench.edit (SetParam { "", "one", "value", Json (0.5 * i) });
        plans.push_back (bench.live.engine().newestShared());
        CHECK (bench.live.engine().clear() <= 3);
        if (i % 3) bench.tick();
    }
    bench.tick();
    CHECK (bench.live.engine().clear() == 1);
    CHECK (std::ranges::count_if (plans, [] (const auto& p) { return ! p.expired(); })
           == 1);
}
