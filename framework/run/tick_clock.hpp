// SPDX-License-Identifier: MIT
#pragma once

#include "realtime.hpp"

#include <algorithm>
#include <chrono>

namespace tactus
{

/// Converts seconds for use with the steady clock.
inline std::chrono::steady_clock::duration toDuration (double s)
{
    return std::chrono::duration_cast<std::chrono::steady_clock::duration> (std::chrono::duration<double> (s));
}

/// An object ticked by a clock.
class Ticked
{
public:
    virtual ~Ticked() = default;

    /// Runs a tick that is due now and starts `late_s` seconds late. Returns false after the last one. [tick thread]
    virtual bool tick (double late_s) noexcept = 0;
};

/// The clock of a run: ticks the run whenever a tick is due. A timer and a free-running clock are below. A device can be a
/// clock that waits for its next report; the callback of an audio card can be a clock that ticks a block at a time on its own
/// thread.
class TickClock
{
public:
    virtual ~TickClock() = default;

    /// Ticks, the first time immediately, until tick() returns false, then returns. The clock may tick on this thread or on a
    /// callback thread, but not on both at the same time; that thread is the tick thread, and it uses the default floating-point
    /// mode. A clock that waits for an external event must not wait forever: when a device falls silent, the clock keeps ticking
    /// with a reading that ages, so that the guard removes the force and a stop request takes effect. [a thread of the run]
    virtual void drive (Ticked&) noexcept = 0;

    /// False if the ticks have no deadlines: then they are never late, and no graph can take too long. [any thread]
    virtual bool isRealTime() const noexcept { return true; }

    /// True if this tick comes from a substitute clock, for instance while the clock's device is silent. Then no force is applied.
    /// [any thread]
    virtual bool isReplaced() const noexcept { return false; }

    /// The length of the blocks in s if the clock runs several ticks at once, or 0 if one tick at a time. [tick thread]
    virtual double block_s() const noexcept { return 0.0; }

    /// The time in s since an arbitrary origin. [tick thread]
    virtual double now() const noexcept { return std::chrono::duration<double> (std::chrono::steady_clock::now().time_since_epoch()).count(); }
};

/// Ticks at deadlines that are one period apart, however long the previous tick took. Missed ticks are not caught up in a burst; the
/// deadlines start again from the current time.
class AbsoluteTimer final : public TickClock
{
public:
    /// A thread wakes up 10 to 100 us after the time it asked for.
    enum class Wait
    {
        punctual,   ///< sleeps until shortly before the deadline, then spins. For motors
        /// Sleeps until the deadline, and is late by the time of waking up. Ticks that begin within the same millisecond are due together, so that a
        /// fast graph does not wake up for each. A fraction of the processor time; for simulated devices
        idle
    };

    explicit AbsoluteTimer (double period_s, Wait w = Wait::punctual)
        : tick_s (period_s), together (w == Wait::idle ? std::max (1, static_cast<int> (1e-3 / std::max (period_s, 1e-6) + 1e-6)) : 1),
          period (toDuration (together * period_s)), wait (w)
    {
    }

    double block_s() const noexcept override { return together > 1 ? together * tick_s : 0.0; }

    void drive (Ticked& ticked) noexcept override
    {
        deadline = Clock::now();
        for (;; deadline += period)
        {
            const double late_s = waited();
            for (int i = 0; i < together; ++i)
                if (! ticked.tick (std::max (0.0, late_s - i * tick_s))) return;
        }
    }

private:
    using Clock = std::chrono::steady_clock;

    /// The longest spin. The kernel stops a SCHED_FIFO thread for 50 ms each second if it never sleeps.
    Clock::duration longestSpin() const noexcept { return std::min (toDuration (50e-6), period / 5); }

    /// Waits for the deadline. Returns how late it is, in s.
    double waited() noexcept
    {
        auto at = Clock::now();
        const auto until = deadline - (wait == Wait::punctual ? std::min (wakeup.expected(), longestSpin()) : Clock::duration {});
        if (until > at)
        {
            sleepUntil (until);
            wakeup.note (Clock::now() - until);
        }
        while ((at = Clock::now()) < deadline)
            ;
        const auto late = at - deadline;
        if (late > period) deadline = at;
        return std::chrono::duration<double> (late).count();
    }

    /// An estimate of the time that the thread takes to wake up: more than nearly all of the latest times.
    class Wakeup
    {
    public:
        Clock::duration expected() const noexcept { return longest; }

        /// Rises to a longer time at once, and sinks by a hundredth of the difference to a shorter one.
        void note (Clock::duration took) noexcept { longest += took > longest ? took - longest : (took - longest) / 100; }

    private:
        Clock::duration longest = toDuration (50e-6);
    };

    double tick_s;            // from one tick to the next
    int together;             // how many ticks are due together
    Clock::duration period;   // of all these ticks
    Wait wait;
    Wakeup wakeup {};
    Clock::time_point deadline;
};

/// Ticks as fast as possible; never late.
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

}   // namespace tactus
