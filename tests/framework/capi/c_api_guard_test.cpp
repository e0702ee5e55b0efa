// SPDX-License-Identifier: MIT
// The state of a guard, as the caller sees it: one that stops its device, in a loop of its own and in one that a clock ticks.
#include "c_handles.hpp"

#include <support/no_allocation.hpp>

#include <catch2/catch.hpp>

#include <string>
#include <vector>

using namespace tactus::test;

namespace
{
/// A run at 1 kHz that pushes the tool with 2 N whatever it does, at most with 1.5 N if the graph keeps its device.
RunHandle pushingRun (const char* limits, const MessageList& m, bool keeps_device = false)
{
    const std::string text = R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000,
        "devices": { "stylus": { "driver": "sim", "guard": { "max_force": "1.5 N" } } },
        "nodes": { "push": { "type": "signal.constant", "params": { "value": "2 N" } }, "motor": { "type": "device.force", "role": "stylus" } },
        "wires": [ "push.out -> motor.force.x" ] })";
    const GraphHandle graph { tactus_graph_parse (text.c_str(), text.size(), nullptr, m.get()) };
    if (! keeps_device) REQUIRE (tactus_graph_set_device (graph.get(), "stylus", nullptr, m.get()) == TACTUS_OK);
    RunHandle run { tactus_run_create (graph.get(), nullptr, m.get()) };
    INFO (said (m));
    REQUIRE (run);
    tactus_device_options device = TACTUS_DEVICE_OPTIONS;
    device.guard = limits;
    device.simulated = 1;
    REQUIRE (tactus_run_pushed_device (run.get(), "stylus", &device, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    return run;
}

/// Holds the tool at rest for a tick.
void tickAtRest (const RunHandle& run)
{
    tactus_reading reading = TACTUS_READING;
    reading.valid = 1;
    REQUIRE (tactus_run_push (run.get(), "stylus", &reading) == TACTUS_OK);
    REQUIRE (tactus_run_tick (run.get()) == TACTUS_OK);
}

double forceOf (const RunHandle& run)
{
    tactus_effort effort = TACTUS_EFFORT;
    REQUIRE (tactus_run_take (run.get(), "stylus", &effort) == TACTUS_OK);
    return effort.force[0];
}

tactus_guard guardOf (const RunHandle& run)
{
    tactus_guard guard = TACTUS_GUARD;
    REQUIRE (tactus_run_guard (run.get(), "stylus", &guard) == TACTUS_OK);
    return guard;
}
}   // namespace

TEST_CASE ("C API: a loop of one's own learns that the guard has stopped a role, why, and by which limit", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = pushingRun (R"({ "max_impulse": "0.1 N*s", "impulse_window": "10 s" })", m);
    CHECK (guardOf (run).stop == TACTUS_STOP_NONE);
    std::vector<std::byte> before;
    double impulse = 0.0;   // summed here from the efforts that were taken
    for (int k = 0; k < 200 && guardOf (run).stop == TACTUS_STOP_NONE; ++k)
    {
        if (k == 10)
        {
            size_t size = 0;
            REQUIRE (tactus_run_save (run.get(), nullptr, 0, &size, m.get()) == TACTUS_OK);
            before.resize (size);
            REQUIRE (tactus_run_save (run.get(), before.data(), size, &size, m.get()) == TACTUS_OK);
        }
        tickAtRest (run);
        if (guardOf (run).stop == TACTUS_STOP_NONE) impulse += forceOf (run) * 1e-3;
    }
    const auto stopped = guardOf (run);
    CHECK (stopped.stop == TACTUS_STOP_IMPULSE);
    CHECK (stopped.latest == TACTUS_STOP_IMPULSE);
    CHECK (stopped.is_latched == 1);
    CHECK (stopped.limit == Approx (0.1));
    CHECK (stopped.window == Approx (10.0));
    CHECK (stopped.value > stopped.limit);
    CHECK (stopped.value == Approx (impulse));
    CHECK (stopped.stops == 1);
    CHECK (std::string (tactus_stop_name (stopped.stop)) == "impulse");
    const Text words { tactus_run_guard_text (run.get(), "stylus") };
    CHECK (std::string (words.get()).find ("the impulse of the force is 0.1") == 0);

    for (int k = 0; k < 20; ++k)
        tickAtRest (run);
    CHECK (forceOf (run) == 0.0);
    CHECK (guardOf (run).stop == TACTUS_STOP_IMPULSE);   // it lasts

    SECTION ("until it is rearmed")
    {
        REQUIRE (tactus_run_rearm (run.get()) == TACTUS_OK);
        tickAtRest (run);
        tickAtRest (run);
        CHECK (guardOf (run).stop == TACTUS_STOP_NONE);
        CHECK (guardOf (run).is_latched == 0);
        CHECK (guardOf (run).latest == TACTUS_STOP_IMPULSE);
        CHECK (forceOf (run) > 0.0);
    }
    SECTION ("or until a state of before is restored")
    {
        REQUIRE (tactus_run_restore (run.get(), before.data(), before.size(), m.get()) == TACTUS_OK);
        CHECK (guardOf (run).stop == TACTUS_STOP_NONE);
        CHECK (guardOf (run).stops == 0);
        tickAtRest (run);
        CHECK (forceOf (run) == 2.0);
    }
}

TEST_CASE ("C API: a loop learns that the guard clips, that readings are missing, and of an emergency stop", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = pushingRun (R"({ "max_force": "1 N" })", m);
    REQUIRE (tactus_run_tick (run.get()) == TACTUS_OK);
    CHECK (guardOf (run).stop == TACTUS_STOP_STALE);
    CHECK (guardOf (run).is_latched == 0);
    for (int k = 0; k < 2200; ++k)
        tickAtRest (run);
    CHECK (guardOf (run).stop == TACTUS_STOP_NONE);
    CHECK (guardOf (run).is_clipping == 1);
    REQUIRE (tactus_run_emergency_stop (run.get()) == TACTUS_OK);
    tickAtRest (run);
    CHECK (guardOf (run).stop == TACTUS_STOP_EMERGENCY);
    CHECK (guardOf (run).is_latched == 1);
    CHECK (guardOf (run).stops == 2);
}

TEST_CASE ("C API: the guard of the graph's device comes in addition, unless the graph has no device for the role", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    const auto forceWith = [&] (const char* limits, bool keeps_device) {
        const auto run = pushingRun (limits, m, keeps_device);
        tickAtRest (run);
        return forceOf (run);
    };
    CHECK (forceWith (nullptr, false) == Approx (2.0));
    CHECK (forceWith (nullptr, true) == Approx (1.5));
    CHECK (forceWith (R"({ "max_force": "1.8 N" })", true) == Approx (1.5));
    CHECK (forceWith (R"({ "max_force": "1.2 N" })", true) == Approx (1.2));
    CHECK (forceWith (R"({ "max_force": "1.2 N" })", false) == Approx (1.2));
}

TEST_CASE ("C API: a guard is asked for at any time, at no cost, and a wrong question is a misuse", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = pushingRun (nullptr, m);
    tactus_guard guard = TACTUS_GUARD;
    CHECK (tactus_run_guard (nullptr, "stylus", &guard) == TACTUS_MISUSE);
    CHECK (tactus_run_guard (run.get(), nullptr, &guard) == TACTUS_MISUSE);
    CHECK (tactus_run_guard (run.get(), "thumb", &guard) == TACTUS_MISUSE);
    CHECK (tactus_run_guard (run.get(), "stylus", nullptr) == TACTUS_MISUSE);
    guard.size = 3;
    CHECK (tactus_run_guard (run.get(), "stylus", &guard) == TACTUS_MISUSE);
    CHECK (tactus_run_guard_text (run.get(), "thumb") == nullptr);
    CHECK (std::string (tactus_stop_name (TACTUS_STOP_NONE)).empty());
    CHECK (std::string (tactus_stop_name (TACTUS_STOP_EMERGENCY)) == "emergency");
    CHECK (tactus_stop_name (static_cast<tactus_stop> (10)) == nullptr);

    guard.size = sizeof guard;
    const NoAllocation watch;
    const auto asked = tactus_run_guard (run.get(), "stylus", &guard), ticked = tactus_run_tick (run.get());
    const int allocations = watch.allocations();
    CHECK (allocations == 0);
    CHECK (asked == TACTUS_OK);
    CHECK (ticked == TACTUS_OK);
}
