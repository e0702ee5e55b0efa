// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <chrono>
#include <thread>

namespace tactus::host
{

/// Who owns the clock of a run: says when each tick is due. A timer and a free run are below; a device's reports or the
/// callbacks of an audio card can be one as well. All of it is for the tick thread.
class TickClock
{
public:
    virtual ~TickClock() = default;

    /// The first tick is due now.
    virtual void begin() noexcept = 0;

    /// Waits until the next tick is due. Returns by how much it is late, in s.
    virtual double wait() noexcept = 0;

    /// The time in s, from any beginning.
    virtual double now() const noexcept { return std::chrono::duration<double> (std::chrono::steady_clock::now().time_since_epoch()).count(); }
};

/// Deadlines one period apart, whenever the tick before was done. It sleeps until shortly before and spins from there:
/// waking up takes some 20 to 50 us. It does not spin longer, since the kernel stops a SCHED_FIFO thread that never sleeps
/// for 50 ms each second. What was missed is not made up for in a burst: the deadlines begin anew.
class AbsoluteTimer final : public TickClock
{
public:
    explicit AbsoluteTimer (double period_s) : period (toDuration (period_s)), spin (std::min (toDuration (50e-6), period / 5)) {}

    void begin() noexcept override { deadline = Clock::now() - period; }

    double wait() noexcept override
    {
        deadline += period;
        auto at = Clock::now();
        if (deadline - spin > at) std::this_thread::sleep_until (deadline - spin);
        while ((at = Clock::now()) < deadline)
            ;
        const auto late = at - deadline;
        if (late > period) deadline = at;
        return std::chrono::duration<double> (late).count();
    }

private:
    using Clock = std::chrono::steady_clock;

    static Clock::duration toDuration (double s) { return std::chrono::duration_cast<Clock::duration> (std::chrono::duration<double> (s)); }

    Clock::duration period, spin;
    Clock::time_point deadline;
};

/// As fast as it goes; never late.
class FreeRun final : public TickClock
{
public:
    void begin() noexcept override {}
    double wait() noexcept override { return 0.0; }
};

}   // namespace tactus::host
