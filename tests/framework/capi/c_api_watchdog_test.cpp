// SPDX-License-Identifier: MIT
// A pushed device whose program stops pushing, in virtual time: in a loop of its own, and in a run that a clock ticks.
#include "c_handles.hpp"

#include <framework/capi/pushed_device.hpp>
#include <tactus/file/graph_file.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/run/device/guard_limits.hpp>
#include <tactus/run/run.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

using namespace tactus::test;
using tactus::capi::PushedDevice;

namespace
{
constexpr double rate_hz = 1000.0, force = 2.0;

/// Pushes the tool with 2 N whatever it does. `devices` is the description of the graph for its device.
std::string pushing (const std::string& devices)
{
    return R"({ "format": "tactus-graph", "version": 2, "rate_hz": 1000, )" + devices + R"(
        "nodes": { "push": { "type": "signal.constant", "params": { "value": "2 N" } }, "motor": { "type": "device.force", "role": "stylus" } },
        "wires": [ "push.out -> motor.force.x" ] })";
}

RunHandle opened (const char* guard, const MessageList& m, const std::string& devices = "")
{
    const auto text = pushing (devices);
    const GraphHandle g { tactus_graph_parse (text.c_str(), text.size(), nullptr, m.get()) };
    RunHandle run { tactus_run_create (g.get(), nullptr, m.get()) };
    INFO (said (m));
    REQUIRE (run);
    tactus_device_options device = TACTUS_DEVICE_OPTIONS;
    device.guard = guard;
    REQUIRE (tactus_run_pushed_device (run.get(), "stylus", &device, m.get()) == TACTUS_OK);
    REQUIRE (tactus_run_open (run.get(), m.get()) == TACTUS_OK);
    return run;
}

double taken (const tactus_run* run)
{
    tactus_effort effort = TACTUS_EFFORT;
    REQUIRE (tactus_run_take (run, "stylus", &effort) == TACTUS_OK);
    return effort.force[0];
}

void push (tactus_run* run)
{
    tactus_reading reading = TACTUS_READING;
    reading.valid = 1;
    REQUIRE (tactus_run_push (run, "stylus", &reading) == TACTUS_OK);
}

/// The force on each tick of a run whose readings stop before the first of these ticks.
std::vector<double> silence (const RunHandle& run, int ticks, double passed_s = 0.0)
{
    for (int k = 0; k < 20; ++k)
    {
        push (run.get());
        REQUIRE (tactus_run_tick (run.get()) == TACTUS_OK);
        REQUIRE (taken (run.get()) == force);
    }
    std::vector<double> forces;
    for (int k = 0; k < ticks; ++k)
    {
        REQUIRE ((passed_s > 0.0 ? tactus_run_tick_after (run.get(), passed_s) : tactus_run_tick (run.get())) == TACTUS_OK);
        forces.push_back (taken (run.get()));
    }
    return forces;
}

/// The number of ticks with the whole force. The age is a sum, and its rounding may cost the last of them. Then the force fades to zero within 5 ms,
/// without a step, and stays there.
std::ptrdiff_t wholeTicks (const std::vector<double>& forces)
{
    const auto begins = std::ranges::find_if (forces, [] (double f) { return f != force; });
    const auto ends = std::ranges::find (forces, 0.0);
    REQUIRE (ends != forces.end());
    CHECK (std::count (ends, forces.end(), 0.0) == forces.end() - ends);
    double largest = 0.0, before = force;
    for (const double now : forces)
        largest = std::max (largest, std::abs (now - std::exchange (before, now)));
    CHECK (largest <= force / (tactus::Guard::fade_s * rate_hz) * (1.0 + 1e-9));
    CHECK (ends - begins <= static_cast<long> (tactus::Guard::fade_s * rate_hz));
    return begins - forces.begin();
}
}   // namespace

TEST_CASE ("C API: without a guard, the force of a pushed device fades to zero 50 periods after its readings stop", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    CHECK (std::abs (wholeTicks (silence (opened (nullptr, m), 200)) - 50) <= 1);
    CHECK (std::abs (wholeTicks (silence (opened ("{}", m), 200)) - 50) <= 1);
    CHECK (std::abs (wholeTicks (silence (opened (R"({ "max_force": "3 N" })", m), 200)) - 50) <= 1);
}

TEST_CASE ("C API: the program's own guard tightens or lengthens the watchdog, and a graph only tightens it", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    CHECK (std::abs (wholeTicks (silence (opened (R"({ "watchdog": "20 ms" })", m), 200)) - 20) <= 1);
    CHECK (std::abs (wholeTicks (silence (opened (R"({ "watchdog": "120 ms" })", m), 200)) - 120) <= 1);
    const auto described = [] (const std::string& watchdog) {
        return R"("devices": { "stylus": { "driver": "sim", "guard": { "watchdog": ")" + watchdog + R"(" } } }, )";
    };
    CHECK (std::abs (wholeTicks (silence (opened (nullptr, m, described ("10 ms")), 200)) - 10) <= 1);
    CHECK (std::abs (wholeTicks (silence (opened (nullptr, m, described ("10 s")), 200)) - 50) <= 1);
    CHECK (std::abs (wholeTicks (silence (opened (R"({ "watchdog": "120 ms" })", m, described ("30 ms")), 200)) - 30) <= 1);
}

TEST_CASE ("C API: a loop that says that its ticks were late loses the force after 50 ms, not after 50 ticks", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    const auto forces = silence (opened (nullptr, m), 100, 1.9e-3);
    CHECK (std::ranges::find_if (forces, [] (double f) { return f != force; }) - forces.begin() == 26);   // 26 x 1.9 ms = 49.4 ms
    CHECK (std::ranges::count (forces, 0.0) > 60);
}

TEST_CASE ("C API: the force of a pushed device returns with its readings, along the ramp", "[c_api][safety]")
{
    const MessageList m { tactus_messages_create() };
    const auto run = opened (R"({ "ramp": "100 ms" })", m);
    const auto play = [&] (int ticks) {
        for (int k = 0; k < ticks; ++k)
        {
            push (run.get());
            REQUIRE (tactus_run_tick (run.get()) == TACTUS_OK);
        }
        return taken (run.get());
    };
    REQUIRE (play (200) == force);
    for (int k = 0; k < 100; ++k)
        REQUIRE (tactus_run_tick (run.get()) == TACTUS_OK);
    CHECK (taken (run.get()) == 0.0);
    CHECK (play (74) == 0.0);   // 1.5 times the watchdog of 50 ms
    CHECK (play (2) < 0.1);
    CHECK (play (50) == Approx (1.0).margin (0.1));
    CHECK (play (100) == force);
}

namespace
{
double virtual_now_s = 0.0;
double virtualSeconds() noexcept { return virtual_now_s; }

/// Ticks a run in virtual time. Its device is pushed before each tick until a time; then only every n-th tick comes.
class VirtualClock final : public tactus::TickClock
{
public:
    VirtualClock (double until, int apart) : silent_at_s (until), period_s (1.0 / rate_hz), ticks_apart (apart) {}

    void drive (tactus::Ticked& run) noexcept override
    {
        for (;;)
        {
            const bool is_silent = virtual_now_s >= silent_at_s;
            if (! is_silent) device->push (reading);
            if (! run.tick (0.0)) return;
            times.push_back (virtual_now_s);
            forces.push_back (device->effort().force[0]);
            virtual_now_s += period_s * (is_silent ? ticks_apart : 1);
        }
    }

    double now() const noexcept override { return virtual_now_s; }

    PushedDevice* device = nullptr;
    tactus_reading reading TACTUS_READING;
    std::vector<double> times, forces;   // after each tick

private:
    double silent_at_s, period_s;
    int ticks_apart;
};

/// Plays 2 N on a pushed device that falls silent after 100 ms, in a run that was started.
VirtualClock startedAndSilent (int ticks_apart, const tactus::GuardLimits& limits = {})
{
    virtual_now_s = 0.0;
    VirtualClock clock { 0.1, ticks_apart };
    clock.reading.valid = 1;
    tactus::Run run { tactus::catalogue(), {}, [&] (const auto&, const auto&, const auto&, auto&) {
                         auto device = std::make_unique<PushedDevice> (tactus::DeviceLayout {}, virtualSeconds);
                         clock.device = device.get();
                         return tactus::Run::RoleDevice { std::move (device), PushedDevice::watched (limits) };
                     } };
    const auto loaded = tactus::readGraph (pushing (""));
    auto messages = run.load (loaded.graph);
    run.openDevices (loaded.graph, messages);
    REQUIRE_FALSE (tactus::hasErrors (messages));
    clock.device->useClock();
    static_cast<void> (run.start (clock, { .length = 300 }));
    run.live().wait();
    return clock;
}
}   // namespace

TEST_CASE ("C API: in a run that was started, the force fades to zero 50 ms after the last reading", "[c_api][safety]")
{
    const auto clock = startedAndSilent (1);
    REQUIRE (clock.forces.size() > 200);
    const std::vector<double> after (clock.forces.begin() + 100, clock.forces.end());
    REQUIRE (clock.forces[99] == force);
    CHECK (std::abs (wholeTicks (after) - 50) <= 1);
}

TEST_CASE ("C API: in a run that was started, ticks that are missing do not prolong the watchdog", "[c_api][safety]")
{
    const auto clock = startedAndSilent (4);   // from 1000 to 250 ticks a second
    const auto zero = std::find (clock.forces.begin() + 100, clock.forces.end(), 0.0);
    REQUIRE (zero != clock.forces.end());
    const double silent_s = clock.times[static_cast<std::size_t> (zero - clock.forces.begin())] - clock.times[99];
    CHECK (silent_s <= PushedDevice::default_watchdog + tactus::Guard::fade_s + 4.0 / rate_hz + 1e-9);
    CHECK (std::all_of (zero, clock.forces.end(), [] (double f) { return f == 0.0; }));
}
