// SPDX-License-Identifier: MIT
// The emergency stop of a live run, a thousand times. Wall times are printed, not judged: they depend on the machine.

#include <tactus/run/runner.hpp>

#include "support/rounds.hpp"
#include "support/sketch.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <iostream>
#include <vector>

using namespace tactus;

namespace
{
constexpr double rate_hz = 4000.0;
const auto fade_ticks = static_cast<std::uint64_t> (std::ceil (Guard::fade_s * rate_hz));
const test::Stopwatch watch;   // for what is printed

/// A device that is pushed with 2 N, and the ticks of its run.
class Pushed final : public Device, public TickHooks
{
public:
    void prepare (double) override {}
    Reading read() noexcept override { return {}; }
    void write (const Effort& e) noexcept override { force = e.force.x(); }

    void before (std::uint64_t tick) noexcept override { begun.exchange (tick + 1); }
    void after (std::uint64_t tick, bool) noexcept override
    {
        if (force != 0.0)
            pushed = tick + 1;
        else if (was != 0.0)
            zero_at_s = watch.s();
        full = force == 2.0;
        was = force;
        ended = tick + 1;
    }

    /// The number of ticks that have begun. All later ticks see what this thread did before this call.
    std::uint64_t ticksBegun() noexcept { return begun.fetch_add (0); }

    std::atomic<std::uint64_t> begun = 0, ended = 0;   ///< number of ticks
    std::atomic<std::uint64_t> pushed = 0;             ///< number of ticks up to the last one with a force
    std::atomic<bool> full = false;                    ///< the last tick had the whole force
    std::atomic<double> zero_at_s = 0.0;               ///< when the force last fell to zero

private:
    double force = 0.0, was = 0.0;   // [tick thread]
};

struct Tries
{
    std::vector<double> called_s, zero_s;   ///< wall time of the call; from the call until the force was zero
    int late = 0;                           ///< tries with a force after the fade and one tick
};

/// Stops and rearms until it has done so `count` times, or the run does not react.
Tries stopOften (Engine& engine, Pushed& device, int count)
{
    Tries tries;
    for (int i = 0; i < count; ++i)
    {
        const auto wait_for = device.ended + 1 + static_cast<std::uint64_t> (i % 3);   // at different places in the tick period, too
        if (! test::eventually ([&] { return device.full && device.ended >= wait_for; })) break;
        test::letPass (std::chrono::microseconds (37 * (i % 7)));

        const double called = watch.s();
        engine.emergencyStop();
        const double returned = watch.s();
        const auto first = device.ticksBegun();   // the number of the tick that follows the call
        const auto end = first + fade_ticks + 1;
        if (! test::eventually ([&] { return device.ended >= end + 2; })) break;
        tries.late += device.pushed > end;
        tries.called_s.push_back (returned - called);
        tries.zero_s.push_back (device.zero_at_s - called);
        engine.rearm();
    }
    return tries;
}

void print (const char* what, std::vector<double> seconds)
{
    std::ranges::sort (seconds);
    std::cout << what << ": median " << 1e6 * seconds[seconds.size() / 2] << " us, max " << 1e6 * seconds.back() << " us\n";
}
}   // namespace

TEST_CASE ("each emergency stop brings the force to zero within the fade and one tick after the call", "[runtime][safety]")
{
    const int count = test::rounds (1000);
    test::Sketch sketch;
    sketch.node ("push", "signal.constant", { { "value", 2.0 } }).node ("motor", "device.force").wire ("push.out -> motor.force.x");
    Engine engine { sketch.compile ({ .rate_hz = rate_hz }).plan };
    Pushed device;
    engine.attach ("stylus", device);
    AbsoluteTimer clock { 1.0 / rate_hz };
    Runner runner { engine, clock, rate_hz, { .hooks = &device } };
    runner.start();
    const auto tries = stopOften (engine, device, count);
    runner.stop();
    runner.wait();

    CHECK (tries.zero_s.size() == static_cast<std::size_t> (count));
    CHECK (tries.late == 0);
    REQUIRE_FALSE (tries.zero_s.empty());
    print ("emergency stop, the call", tries.called_s);
    print ("emergency stop, from the call until the force is zero", tries.zero_s);
}
