// SPDX-License-Identifier: MIT
// Axes and signals between nodes and devices.

#include "support/no_allocation.hpp"
#include "support/sketch.hpp"

#include "support/live.hpp"
#include <support/property.hpp>
#include <tactus/plan/rules/missing_parts.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <random>

using namespace tactus;
using test::Sketch;

namespace
{
constexpr double rate_hz = 1000.0;

/// Has axes, buttons and signals, and records the efforts it receives.
struct Pad final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override { return reading; }
    void write (const Effort& e) noexcept override { last = e; }
    DeviceLayout layout() const override { return has; }

    DeviceLayout has { .axes = { "stick", "trigger" }, .efforts = { "brake", "trigger" }, .buttons = { "grip" }, .signal_inputs = 1, .signal_outputs = 2 };
    Reading reading;
    Effort last;
};

/// The trigger is a spring. The grip button and the signal input are added up on output channel 2.
Sketch padSketch()
{
    Sketch s;
    s.node ("trigger", "device.axis", {}, { { "axis", "trigger" } })
        .node ("spring", "signal.gain", { { "gain", -3.0 } })
        .node ("push", "device.effort", {}, { { "axis", "trigger" } });
    s.node ("grip", "device.button", {}, { { "button", "grip" } }).node ("tip", "device.signal_in").node ("out", "device.signal_out", {}, { { "channel", 2 } });
    return s.wire ("trigger.axis -> spring.in").wire ("spring.out -> push.effort").wire ("grip.pressed -> out.in").wire ("tip.out -> out.in");
}
}   // namespace

TEST_CASE ("axes, buttons and signals of a device reach the graph by name, and efforts and signals reach the device by name", "[live]")
{
    const auto [plan, messages] = padSketch().compile ({ .rate_hz = rate_hz, .records = { "trigger.axis" } });
    INFO (test::text (messages));
    REQUIRE (plan);
    Engine engine { plan };
    Pad pad;
    engine.attach ("stylus", pad);
    CHECK (missingParts (*plan).empty());
    pad.reading.axes = { 0.1, 0.5 };
    pad.reading.signals = { 0.25 };
    pad.reading.buttons = 1;
    {
        const NoAllocation watch;
        engine.tick();
        CHECK (watch.allocations() + watch.locks() == 0);
    }
    CHECK (*plan->taps()[0].value == 0.5);
    CHECK (pad.last.axes.size() == 2);
    CHECK (pad.last.axes[0] == 0.0);
    CHECK (pad.last.axes[1] == -1.5);
    CHECK (pad.last.signals[1] == 1.25);   // the sum of both wires
    CHECK (pad.last.force.isZero (0.0));
}

TEST_CASE ("a missing part of a device is reported once per role and name, with the parts that exist", "[live]")
{
    auto s = padSketch();
    s.node ("again", "device.axis", {}, { { "axis", "triger" } })
        .node ("other", "device.axis", {}, { { "axis", "triger" } })
        .node ("third", "device.signal_out", {}, { { "channel", 3 } });
    s.node ("left", "device.axis", {}, { { "axis", "trigger" } });
    s.graph.root.nodes.back().role = "left";
    const auto plan = s.compile ({ .rate_hz = rate_hz }).plan;
    REQUIRE (plan);
    Engine engine { plan };
    Pad pad, bare;
    bare.has = {};
    engine.attach ("stylus", pad);
    engine.attach ("left", bare);
    const auto messages = missingParts (*plan);
    REQUIRE (messages.size() == 3);
    CHECK (std::ranges::all_of (messages, [] (const Message& m) { return m.id == "device/missing_part" && m.severity == Message::Severity::warning; }));
    const auto all = test::text (messages);
    INFO (all);
    CHECK (all.find ("/nodes/left: 'left' (device.axis): the device of the role 'left' has no axis 'trigger'; it has no axes at all; the node reads 0 until")
           != std::string::npos);
    CHECK (all.find ("the device of the role 'stylus' has no axis 'triger' (did you mean 'trigger'?); its axes: 'stick', 'trigger'") != std::string::npos);
    CHECK (all.find ("'third' (device.signal_out): the device of the role 'stylus' has no signal output 3; it has 2; the node has no effect until")
           != std::string::npos);
    engine.tick();
    CHECK (pad.last.signals.size() == 2);
}

TEST_CASE ("efforts and signals of several nodes have bit-identical sums in any order", "[live][property]")
{
    test::property ("any values", [] {
        const auto values = *rc::gen::container<std::vector<double>> (6, rc::gen::element (1e-17, 0.1, 0.2, 0.3, -0.7, 1e9));
        std::vector<std::size_t> order { 0, 1, 2, 3, 4, 5 };
        const auto run = [&] {
            Sketch s;
            for (const auto i : order)
            {
                const auto n = std::to_string (i);
                s.node ("c" + n, "signal.constant", { { "value", values[i] } })
                    .node ("e" + n, "device.effort", {}, { { "axis", "trigger" } })
                    .node ("s" + n, "device.signal_out");
                s.wire ("c" + n + ".out -> e" + n + ".effort").wire ("c" + n + ".out -> s" + n + ".in");
            }
            Engine engine { s.compile ({ .rate_hz = rate_hz }).plan };
            Pad pad;
            engine.attach ("stylus", pad);
            engine.tick();
            return std::pair { std::bit_cast<std::uint64_t> (pad.last.axes[1]), std::bit_cast<std::uint64_t> (pad.last.signals[0]) };
        };
        const auto first = run();
        std::ranges::shuffle (order, std::mt19937 { *rc::gen::arbitrary<unsigned>() });
        RC_ASSERT (run() == first);
        RC_ASSERT (first.first == first.second);
    });
}

TEST_CASE ("a plan that takes over causes no step in axes or signals", "[live]")
{
    auto s = Sketch {}
                 .node ("one", "signal.constant", { { "value", 2.0 } })
                 .node ("push", "device.effort", {}, { { "axis", "brake" } })
                 .node ("out", "device.signal_out");
    s.wire ("one.out -> push.effort").wire ("one.out -> out.in");
    test::Live live { s.graph, catalogue(), { .rate_hz = rate_hz }, s.compile ({ .rate_hz = rate_hz }).plan };
    Pad pad;
    live.engine().attach ("stylus", pad);
    for (int k = 0; k < 10; ++k)
        live.engine().tick();
    REQUIRE (pad.last.axes[0] == 2.0);
    REQUIRE (pad.last.signals[0] == 2.0);

    REQUIRE_FALSE (hasErrors (live.perform (graph::RemoveNode { .patch = {}, .name = "push" })));
    REQUIRE_FALSE (hasErrors (live.perform (graph::RemoveNode { .patch = {}, .name = "out" })));
    double before = 2.0, largest = 0.0;
    for (int k = 0; k < 20; ++k)
    {
        live.engine().tick();
        CHECK (pad.last.axes[0] == pad.last.signals[0]);
        largest = std::max (largest, std::abs (pad.last.axes[0] - before));
        before = pad.last.axes[0];
    }
    CHECK (before == 0.0);
    CHECK (largest < 2.0 * 3.1416 / (2.0 * Bumpless::fall_s * rate_hz) + 1e-9);
}

TEST_CASE ("existing nodes are given the parts of a device that joins", "[live]")
{
    auto s = Sketch {}.node ("trigger", "device.axis", {}, { { "axis", "trigger" } });
    s.node ("push", "device.effort", {}, { { "axis", "trigger" } }).wire ("trigger.axis -> push.effort");
    Engine engine { s.compile ({ .rate_hz = rate_hz }).plan };
    for (int k = 0; k < 5; ++k)
        engine.tick();   // without a device

    Pad pad;
    pad.reading.axes = { 0.0, 0.5 };
    const Engine::Joining joining { "stylus", pad };
    auto next = s.compile ({ .rate_hz = rate_hz, .before = &engine.newest() }).plan;
    REQUIRE (next);
    engine.submit (next, std::span (&joining, 1));
    CHECK (missingParts (*next).empty());
    const NoAllocation watch;
    for (int k = 0; k < 150; ++k)
        engine.tick();
    CHECK (watch.allocations() + watch.locks() == 0);
    CHECK (pad.last.axes[1] == 0.5);
}

TEST_CASE ("an emergency stop from another thread holds all efforts at zero until rearmed, including those of new roles", "[live]")
{
    auto s = Sketch {}.node ("one", "signal.constant", { { "value", 2.0 } }).node ("push", "device.effort", {}, { { "axis", "trigger" } });
    s.wire ("one.out -> push.effort");
    Engine engine { s.compile ({ .rate_hz = rate_hz }).plan };
    Pad right, left;
    engine.attach ("stylus", right);
    for (int k = 0; k < 10; ++k)
        engine.tick();
    REQUIRE (right.last.axes[1] == 2.0);

    engine.emergencyStop();
    engine.resume();   // does not end the emergency stop
    for (int k = 0; k < 6; ++k)
        engine.tick();
    CHECK (engine.isAtRest());
    CHECK (right.last.axes[1] == 0.0);

    s.node ("other", "device.effort", {}, { { "axis", "brake" } }).wire ("one.out -> other.effort");
    s.graph.root.nodes.back().role = "left";
    const Engine::Joining joining { "left", left };
    engine.submit (s.compile ({ .rate_hz = rate_hz, .before = &engine.newest() }).plan, std::span (&joining, 1));
    for (int k = 0; k < 50; ++k)
        engine.tick();
    CHECK (engine.isAtRest());
    CHECK (engine.isEmergency());
    CHECK (engine.guardOf ("left").stop() == Guard::Stop::emergency);

    const auto log = engine.guardLog().since();
    REQUIRE (log.size() == 2);
    CHECK (log[0].role == "stylus");
    CHECK (log[0].tick == 10);
    CHECK (log[0].event.why == Guard::Stop::emergency);
    CHECK (log[1].role == "left");

    engine.rearm();
    for (int k = 0; k < 20; ++k)
        engine.tick();
    CHECK_FALSE (engine.isEmergency());
    CHECK (right.last.axes[1] == Approx (2.0 * 20 / (Guard::rearm_ramp_s * rate_hz)));
    for (int k = 20; k <= Guard::rearm_ramp_s * rate_hz; ++k)
        engine.tick();
    CHECK (right.last.axes[1] == 2.0);
    CHECK (left.last.axes[0] == 2.0);
}
