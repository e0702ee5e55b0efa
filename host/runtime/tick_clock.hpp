// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace tactus::host
{

/// What a clock ticks.
class Ticked
{
public:
    virtual ~Ticked() = default;

    /// One tick, which is due and begins this much late, in s. False after the last one. [tick thread]
    virtual bool tick (double late_s) noexcept = 0;
};

/// Who owns the clock of a run: has it tick whenever a tick is due. A timer and a free run are below. A device is one that
/// waits for its next report; the callback of an audio card is one that ticks a block at a time on a thread of its own.
class TickClock
{
public:
    virtual ~TickClock() = default;

    /// Ticks, the first time at once, until tick() returns false, and then returns. Whether on this thread or on one that
    /// something calls back on is the clock's affair, as long as it is one at a time; that is the tick thread then, and
    /// its floating-point mode is the default one. Who waits for something from outside does not wait for ever: a
    /// device that falls silent is ticked on, with a reading that grows old, so that its guard takes the force off and a
    /// request to stop is heard. [a thread of the run]
    virtual void drive (Ticked&) noexcept = 0;

    /// False if ticks are never late, so that a graph cannot take too long for them.
    virtual bool isRealTime() const noexcept { return true; }

    /// True of a tick that something else gives in its place, as while its device is silent: nobody is to be pushed on it.
    /// [any thread]
    virtual bool isReplaced() const noexcept { return false; }

    /// The time in s, from any beginning. [tick thread]
    virtual double now() const noexcept { return std::chrono::duration<double> (std::chrono::steady_clock::now().time_since_epoch()).count(); }
};

/// Deadlines one period apart, whenever the tick before was done. It sleeps until shortly before and spins from there:
/// waking up takes some 20 to 50 us. It does not spin longer, since the kernel stops a SCHED_FIFO thread that never sleeps
/// for 50 ms each second. What was missed is not made up for in a burst: the deadlines begin anew.
class AbsoluteTimer final : public TickClock
{
public:
    explicit AbsoluteTimer (double period_s) : period (toDuration (period_s)), spin (std::min (toDuration (50e-6), period / 5)) {}

    void drive (Ticked& ticked) noexcept override
    {
        deadline = Clock::now();
        while (ticked.tick (wait()))
            deadline += period;
    }

private:
    using Clock = std::chrono::steady_clock;

    static Clock::duration toDuration (double s) { return std::chrono::duration_cast<Clock::duration> (std::chrono::duration<double> (s)); }

    /// Until the deadline; returns by how much it is over, in s.
    double wait() noexcept
    {
        auto at = Clock::now();
        if (deadline - spin > at) std::this_thread::sleep_until (deadline - spin);
        while ((at = Clock::now()) < deadline)
            ;
        const auto late = at - deadline;
        if (late > period) deadline = at;
        return std::chrono::duration<double> (late).count();
    }

    Clock::duration period, spin;
    Clock::time_point deadline;
};

/// As fast as it goes; never late.
class FreeRun final : public TickClock
{
public:
    void drive (Ticked& ticked) noexcept override
    {
        while (ticked.tick (0.0))
            ;
    }

    bool isRealTime() const noexcept override { return false; }
};

}   // namespace tactus::host
