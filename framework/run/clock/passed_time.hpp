// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

namespace tactus
{

/// The time that passes from one tick of a run to the next, by the wall clock. The guards count it, so their limits hold in seconds
/// and not in ticks: a device that reports faster than its profile says gains nothing, and ticks that are missing count.
/// Why: docs/decisions/wall_time.md.
///
/// A tick usually takes one period out of what the clock has added, and leaves the rest to later ticks, so a little jitter, and the ticks of a block,
/// look like regular ticks. If a tick is later than that, all but a block passes at once. So
///
///     c += w        p = c > (B > 0 ? 2 T + 2 B : 1.25 T) ? c - B : min (c, T)        c -= p
///
/// w: wall time since the last tick, p: time that passes, T: period, B: block; c is what is left, from 0 to T/4, or to T + 2 B. The sum of all p is
/// never more than the wall time plus one period (for the first tick), and never less by more than c. What is left is time that a guard does not know of
/// yet, although a reading that came in it shows its motion: so it is short where devices are read by the wall clock.
class PassedTime
{
public:
    explicit PassedTime (double period_s) noexcept : period (period_s) {}

    /// The time that passes before a tick that begins now, in s. The first tick takes one period. `block_s` is the length of the blocks in
    /// which the clock ticks, in s; 0 if it ticks one at a time. [tick thread]
    double operator() (double now_s, double block_s) noexcept
    {
        left += has_begun ? std::max (0.0, now_s - before) : period;
        has_begun = true;
        before = std::max (before, now_s);
        const bool is_late = left > (block_s > 0.0 ? 2.0 * (period + block_s) : (1.0 + jitter) * period), is_whole = left >= just_under * period;
        const double passed = is_late ? left - block_s : is_whole ? period
                                                                  : std::max (0.0, left);
        left -= passed;
        return passed;
    }

private:
    static constexpr double just_under = 1.0 - 1e-6;   // rounding must not make a period look like less
    static constexpr double jitter = 0.25;             // of a period

    double period;
    double before = 0.0, left = 0.0;   // time of the last tick; what is left; in s
    bool has_begun = false;
};

}   // namespace tactus
