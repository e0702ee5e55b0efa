// SPDX-License-Identifier: MIT
// Measures how the force responds when something goes wrong. The results are the table in docs/safety.md.
//
//     TACTUS_UPDATE=1 build/release/bin/tactus_framework_tests "the table of faults*"       rewrites the table

#include "support/sketch.hpp"

#include "support/live.hpp"
#include <tactus/run/runner.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <optional>
#include <sstream>

using namespace tactus;

namespace
{
constexpr double rate_hz = 4000.0, push = 2.0, not_a_number = std::numeric_limits<double>::quiet_NaN();

struct Tool final : Device
{
    void prepare (double) override {}
    Reading read() noexcept override
    {
        reading.position.z() += speed / rate_hz;
        silent_ticks = is_silent ? silent_ticks + 1 : 0;
        reading.age = silent_ticks / rate_hz;
        return reading;
    }
    void write (const Effort& e) noexcept override { force = e.force.norm(); }

    Reading reading { .buttons = 1 };
    double speed = 0.0;   // upwards, in m/s
    bool is_silent = false;
    int silent_ticks = 0;
    double force = 0.0;
};

/// A graph that pushes the tool up with 2 N through a model, as a wall does.
test::Sketch pushedUp()
{
    test::Sketch s;
    s.node ("hand", "device.position").node ("depth", "signal.constant", { { "value", 1.0 } }).node ("push", "signal.gain", { { "gain", push } });
    s.node ("join", "vector.join").node ("motor", "device.force");
    return s.wire ("depth.out -> push.in").wire ("push.out -> join.z").wire ("join.out -> motor.force");
}

struct Bench
{
    explicit Bench (const GuardLimits& limits)
        : live (pushedUp().graph, catalogue(), options(), pushedUp().compile (options()).plan)
    {
        live.engine().attach ("stylus", tool, limits);
        feed();
    }

    static CompileOptions options() { return { .rate_hz = rate_hz, .feeds = { "motor.force.x", "push.gain" } }; }

    void tick()
    {
        feed();
        live.engine().tick();
    }

    /// Feeds the two inputs: a sideways force, and the gain of the push.
    void feed()
    {
        live.engine().takeSubmitted();
        live.engine().plan().setFeeds (std::vector { beside, pushes });
    }

    Tool tool;
    test::Live live;
    double beside = 0.0, pushes = push;
};

struct Fault
{
    std::string name;
    GuardLimits limits;
    std::function<void (Bench&)> happens, ends;
    bool rearm = false;
};

/// A time in ms; empty if the event never happened.
using Ms = std::optional<double>;

struct Measured
{
    Ms to_zero, back;
    double largest_step = 0.0;   // from tick to tick, in N
    std::string message;
    bool stays_away = true;   // true if the force stays at zero until rearm, for faults that need a rearm
};

Measured measure (const Fault& fault)
{
    Bench bench { fault.limits };
    Measured m;
    double before = 0.0;
    const auto ticksUntil = [&] (double wanted, int most) -> Ms {
        for (int k = 1; k <= most; ++k)
        {
            bench.tick();
            REQUIRE (std::isfinite (bench.tool.force));
            m.largest_step = std::max (m.largest_step, std::abs (bench.tool.force - before));
            before = bench.tool.force;
            if (bench.tool.force == wanted) return 1e3 * k / rate_hz;
        }
        return {};
    };
    REQUIRE (ticksUntil (push, 2000));
    for (int k = 0; k < 100; ++k)
        bench.tick();
    REQUIRE (bench.tool.force == push);
    m.largest_step = 0.0;

    fault.happens (bench);
    m.to_zero = ticksUntil (0.0, 8000);
    const auto& guard = bench.live.engine().guardOf ("stylus");
    m.message = guard.stop() != Guard::Stop::none ? describe (guard.latest()) : "";
    fault.ends (bench);
    if (fault.rearm)
    {
        m.stays_away = ! ticksUntil (push, 4000);
        bench.live.engine().rearm();
    }
    m.back = ticksUntil (push, 8000);
    return m;
}

/// Rounds to two decimals, without trailing zeros.
std::string inWords (double v)
{
    std::ostringstream text;
    text.imbue (std::locale::classic());
    text << std::round (v * 100.0) / 100.0;
    return text.str();
}

std::string rowOf (const Fault& fault, const Measured& m)
{
    const auto ms = [] (Ms v, const char* otherwise) { return v ? inWords (*v) : std::string (otherwise); };
    return "| " + fault.name + " | " + ms (m.to_zero, "keeps running") + " | " + inWords (m.largest_step) + " | "
           + (m.message.empty() ? "" : "\"" + m.message + "\"") + " | "
           + (! m.to_zero ? "" : (fault.rearm ? "rearm, then " : "") + ms (m.back, "never")) + " |";
}

/// Long because it is one table of cases, in the order of the rows in docs/safety.md.
std::vector<Fault> faults()
{
    // Limits as in the profile of a small desktop device.
    const GuardLimits profile { .max_force = 3.3, .max_slew = 2000.0, .ramp = 0.1, .watchdog = 0.02 };
    const auto with = [&] (auto change) {
        auto limits = profile;
        change (limits);
        return limits;
    };
    const auto nothing = [] (Bench&) {};
    const auto still = [] (Bench& b) { b.tool.speed = 0.0; };

    return {
        { "a force in the graph is not a number", profile, [] (Bench& b) { b.beside = not_a_number; },
          [] (Bench& b) { b.beside = 0.0; } },
        { "a parameter of a model is not a number: the model outputs 0", profile, [] (Bench& b) { b.pushes = not_a_number; },
          [] (Bench& b) { b.pushes = push; } },
        { "the device's reading is not a number", profile, [] (Bench& b) { b.tool.reading.position.x() = not_a_number; },
          [] (Bench& b) { b.tool.reading.position.x() = 0.0; } },
        { "the device reports that it has no reading", profile, [] (Bench& b) { b.tool.reading.valid = false; },
          [] (Bench& b) { b.tool.reading.valid = true; } },
        { "the device falls silent (watchdog 20 ms)", profile, [] (Bench& b) { b.tool.is_silent = true; },
          [] (Bench& b) { b.tool.is_silent = false; } },
        { "an edit that does not compile", profile,
          [] (Bench& b) { CHECK (hasErrors (b.live.perform (graph::AddWire { .patch = {}, .wire = *graph::parseWire ("missing.out -> push.in") }))); },
          nothing },
        { "an edit that removes the motor", profile,
          [] (Bench& b) { CHECK_FALSE (hasErrors (b.live.perform (graph::SetNodeKey { .patch = {}, .node = "motor", .key = "bypass", .value = true }))); },
          [] (Bench& b) { b.live.undo(); } },
        { "the hand releases the dead-man's switch", with ([] (auto& l) { l.dead_man_buttons = 1; }),
          [] (Bench& b) { b.tool.reading.buttons = 0; },
          [] (Bench& b) { b.tool.reading.buttons = 1; } },
        { "the end of a run, the stop button", profile, [] (Bench& b) { b.live.engine().halt(); },
          [] (Bench& b) { b.live.engine().resume(); } },
        { "the emergency stop", profile, [] (Bench& b) { b.live.engine().emergencyStop(); },
          nothing, true },
        { "the tool is torn away at 3 m/s (limit 1 m/s)", with ([] (auto& l) { l.max_speed = 1.0; }),
          [] (Bench& b) { b.tool.speed = -3.0; },
          still, true },
        { "the device drives the hand with 0.4 W (limit 20 mJ in 1 s)", with ([] (auto& l) { l.max_energy = 0.02; l.energy_window = 1.0; }),
          [] (Bench& b) { b.tool.speed = 0.2; },
          still, true },
        { "2 N for longer than allowed (limit 0.4 N*s in 1 s)", with ([] (auto& l) { l.max_impulse = 0.4; l.impulse_window = 1.0; }),
          nothing, nothing, true },
    };
}

std::filesystem::path document() { return std::filesystem::path { TACTUS_SOURCE_DIR } / "docs/safety.md"; }

/// A real-time clock in virtual time. From tick `slow_from` on, each tick takes `computing` periods, and the next one begins
/// `waiting` periods later.
struct Slow final : TickClock, TickHooks
{
    void drive (Ticked& t) noexcept override
    {
        while (t.tick (0.0))
            time += (ticks < slow_from ? 0.5 : waiting) / rate_hz;
    }
    double now() const noexcept override { return time; }
    void before (std::uint64_t tick) noexcept override
    {
        ticks = tick;
        time += (tick < slow_from ? 0.5 : computing) / rate_hz;
    }
    void after (std::uint64_t, bool) noexcept override
    {
        largest_step = std::max (largest_step, std::abs (tool->force - last));
        last = tool->force;
        if (ticks > slow_from && zero_at == 0.0 && last == 0.0) zero_at = time;
    }

    static constexpr std::uint64_t slow_from = 1000;
    Tool* tool = nullptr;
    double computing = 1.0, waiting = 0.0;   // in periods
    std::uint64_t ticks = 0;
    double time = 0.0, last = 0.0, largest_step = 0.0, zero_at = 0.0;
};

/// A run that cannot keep up, in wall time.
std::string slowRow (const std::string& name, double computing, double waiting, std::uint64_t length, RunStatus::End end, const std::string& in_the_end)
{
    auto engine = Engine { pushedUp().compile ({ .rate_hz = rate_hz }).plan };
    Tool tool;
    constexpr double watchdog = 0.02;
    engine.attach ("stylus", tool, { .max_force = 3.3, .max_slew = 2000.0, .watchdog = watchdog });
    Slow clock;
    clock.tool = &tool;
    clock.computing = computing;
    clock.waiting = waiting;
    Runner runner { engine, clock, rate_hz, { .length = length, .hooks = &clock } };
    runner.start();
    runner.wait();
    CHECK (runner.status().end == end);
    CHECK (tool.force == 0.0);
    const double to_zero = clock.zero_at - static_cast<double> (Slow::slow_from) / rate_hz;
    CHECK (to_zero <= 2.0 * watchdog + Guard::fade_s + 2.0 * (computing + waiting) / rate_hz);
    return "| " + name + " | " + inWords (1e3 * to_zero) + " | " + inWords (clock.largest_step) + " | \"" + describe (runner.status().roles[0].event)
           + "\" | " + in_the_end + " |";
}
}   // namespace

TEST_CASE ("the table of faults in docs/safety.md is correct", "[runtime][safety]")
{
    std::string table;
    for (const auto& fault : faults())
    {
        INFO (fault.name);
        const auto m = measure (fault);
        CHECK (m.stays_away);
        CHECK (m.largest_step <= 2000.0 / rate_hz + 1e-12);
        if (m.to_zero)
            CHECK (m.back);
        else
            CHECK (m.largest_step == 0.0);
        table += rowOf (fault, m) + "\n";
    }
    table += slowRow ("the machine is too busy: the run gets a tenth of its ticks", 0.5, 9.5, 3000, RunStatus::End::length,
                      "rises along the ramp once the run keeps up")
             + "\n";
    table += slowRow ("a graph that takes four times as long as a tick period", 4.0, 0.0, 1'000'000, RunStatus::End::overrun,
                      "the run ends 500 ms after its first late tick")
             + "\n";

    std::ifstream in (document());
    std::stringstream all;
    all << in.rdbuf();
    auto text = all.str();
    const std::string begin = "| fault | ms to zero | largest step (N) | message | ms to full force |\n|---|---:|---:|---|---:|\n";
    const auto from = text.find (begin);
    REQUIRE (from != std::string::npos);
    const auto first = from + begin.size(), last = text.find ("\n\n", first - 1) + 1;
    if (std::getenv ("TACTUS_UPDATE")) std::ofstream (document()) << text.replace (first, last - first, table);
    CHECK (text.substr (first, table.size()) == table);
}
