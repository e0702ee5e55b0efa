// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace tactus
{

/// Compares the ticks of a run with the wall clock, and finds the time for which ticks are missing, because the machine is too slow
/// or busy. The guards count this time too, so ramps aside, their limits hold in seconds and not in ticks.
///
/// Time is lost once a tick begins too late by more than a period plus a block. Until then the clock can still catch up.
class LostTime
{
public:
    explicit LostTime (double period_s) noexcept : period (period_s) {}

    /// The time in s that is lost before a tick that begins now. `block_s` is the length of the blocks in which the clock ticks, in
    /// s; 0 if it ticks one at a time. [tick thread]
    double operator() (double now_s, double block_s) noexcept
    {
        const double late = now_s - due;
        const bool is_lost = has_begun && late > period + block_s;
        if (! has_begun || is_lost) due = now_s;
        // A clock that is faster than the nominal rate must not save up time.
        due = std::min (due + period, now_s + 2.0 * (period + block_s));
        has_begun = true;
        return is_lost ? late : 0.0;
    }

private:
    double period;
    double due = 0.0;   // the time at which the next tick should begin, in s
    bool has_begun = false;
};

}   // namespace tactus
