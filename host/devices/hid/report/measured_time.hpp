// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>

namespace tactus::host::hid
{

/// The time at which a reading was measured, as far as it can be known. A reading that comes late shows where the tool was, not where it is: if it
/// counted as new, the tool would seem to stand still, and then to jump by everything that it has moved meanwhile.
///
///  - With a clock s of the device (a time stamp, or the number of the reading times its period), the reading is older than its arrival t by
///
///        lag = (t - r s) - o,    o = min (o of the last reading + d T, t - r s)    T: time since the last reading, d: 1 %
///
///    r is the speed of the computer's clock divided by that of the device, measured over spans of 2 s, so the lag does not grow
///    if the clock is always too fast or too slow. Before the end of the first span, the device counts as one without a clock. If the lag
///    exceeds 0.1 s, the clock is wrong, and is measured again.
///  - Otherwise, the tool is assumed to keep its speed if that is possible with a lag of at most a period, so jitter does not make it seem
///    faster; and the lag goes to half a period by 15 % of the difference with each reading, so that a speed that is measured a little too high does not
///    keep itself. After a silence, it cannot be known whether the reading is late or others are lost: if the tool has moved much less than its
///    speed so far explains, the reading counts as late by up to the silence, until the motion after it shows that it was not.
///
/// A tool that is slower than 5 cm/s gets no lag, as it moves little during a delay. A lag is at most the time since the last arrival plus the last lag,
/// so measured times do not go back. The times between readings add up to the time between their arrivals, except for the lag, so a clock cannot hide a
/// speed for longer than its lag. Does not allocate or throw.
class MeasuredTime
{
public:
    static constexpr double span_s = 2.0, drift = 0.01, most_lag_s = 0.1;

    /// `period_s`: between two readings; 0: unknown, so that the lag is 0 without a clock of the device.
    explicit MeasuredTime (bool has_clock, double period_s) noexcept : is_timed (has_clock), period (period_s) {}

    /// Takes a new reading. `passed_on_clock_s`: the time since the last one, by the clock of the device. Returns its lag, in s.
    double operator() (double passed_on_clock_s, double arrived_s, const Vec3& position) noexcept;

private:
    void learnRate (bool is_on_time, double late) noexcept;
    double lagByClock() noexcept;
    double lagByMotion (double passed_s, double moved) noexcept;

    bool is_timed;
    double period;
    bool has_one = false, is_learnt = false, has_span = false;
    double now = 0.0, clock = 0.0;                                   // the last arrival, and the clock of the device then
    double span_now = 0.0, span_clock = 0.0;                         // at the beginning of the span
    double rate = 1.0, from = 0.0, from_clock = 0.0, offset = 0.0;   // r, where it holds from, and o
    double lag = 0.0;
    bool is_late = false;   // the last reading counts as late because of its motion
    Vec3 last = Vec3::Zero(), velocity = Vec3::Zero();
};

}   // namespace tactus::host::hid
