// SPDX-License-Identifier: MIT
#pragma once

#include "no_allocation.hpp"
#include "sketch.hpp"

#include <tactus/run/runner.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <thread>

namespace tactus::test
{

/// Counts the locks and allocations of the tick thread, in the ticks and while it waits for the next one. A clock may tick on
/// several threads, one at a time; each counts from its first tick on.
class CountLocks final : public TickHooks
{
public:
    explicit CountLocks (std::uint64_t ticks) : last (ticks) {}

    void before (std::uint64_t tick) noexcept override
    {
        if (is_over) return;
        thread_local std::optional<NoAllocation> watch;
        if (! watch || user != this)
        {
            watch.reset();
            watch.emplace();
            user = this;
        }
        locks = std::max (locks, watch->locks());
        allocations = std::max (allocations, watch->allocations());
        if (tick < last) return;
        watch.reset();
        is_over = true;
    }
    void after (std::uint64_t, bool) noexcept override {}

    std::atomic<bool> is_over = false;   ///< true once enough ticks were counted
    int locks = 0, allocations = 0;      ///< the most on one thread; read them after the run

private:
    static inline thread_local const CountLocks* user = nullptr;   // which object the watch of this thread counts for

    const std::uint64_t last;
};

/// Runs a graph with this clock, and with a device if there is one, and counts the locks of so many ticks. `drive` makes the clock
/// tick; it is called again and again until the run is over.
inline void checkThatTicksLockNothing (TickClock& clock, Device* device, std::uint64_t ticks, const std::function<void()>& drive)
{
    constexpr double rate_hz = 1000.0;
    Sketch s;
    s.node ("hand", "device.position").node ("wall", "deform.plane", { { "offset", "1 mm" } }).node ("motor", "device.force");
    s.wire ("hand.position -> wall.position").wire ("wall.force -> motor.force");
    Engine engine { s.compile ({ .rate_hz = rate_hz }).plan };
    if (device != nullptr) engine.attach ("stylus", *device, { .max_force = 2.0, .ramp = 0.01, .watchdog = 0.1, .max_speed = 2.0 });

    CountLocks counted { ticks };
    Runner runner { engine, clock, rate_hz, { .hooks = &counted } };
    runner.start();
    while (! counted.is_over && ! runner.isOver())
        drive();
    runner.stop();
    while (! runner.isOver())
        drive();
    runner.wait();
    CHECK (counted.is_over);
    CHECK (counted.locks == 0);
    CHECK (counted.allocations == 0);
}

}   // namespace tactus::test
