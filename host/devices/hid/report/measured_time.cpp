// SPDX-License-Identifier: MIT
#include "measured_time.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host::hid
{

namespace
{
constexpr double tau = 0.005;        // of the speed so far, in s; that of the guard
constexpr double silence = 1.5;      // in periods
constexpr double much_less = 0.75;   // of the motion that the speed so far explains
constexpr double much_more = 1.5;
constexpr double to_middle = 0.15;   // by how much a lag goes to half a period, the middle of what is possible: else a wrong speed would keep itself
constexpr double slow = 0.05;        // m/s: such a tool moves little during a delay
}   // namespace

/// Measures the speed of the device's clock, from one reading to another, both on time if possible.
void MeasuredTime::learnRate (bool is_on_time, double late) noexcept
{
    const double passed = now - span_now;
    if (! has_span && is_on_time)
    {
        has_span = true;
        span_now = now;
        span_clock = clock;
    }
    if (! has_span || passed < span_s || (! is_on_time && passed < 2.0 * span_s)) return;
    const double r = passed / (clock - span_clock);
    span_now = now;
    span_clock = clock;
    if (! (r > 0.0) || ! isFinite (r)) return;
    rate = r;
    from = now;
    from_clock = clock;
    offset = -late;   // so that the lag is continuous
    is_learnt = true;
}

double MeasuredTime::lagByClock() noexcept
{
    const double difference = (now - from) - rate * (clock - from_clock);
    offset = std::min (offset, difference);
    const double late = difference - offset;
    if (late <= most_lag_s) return late;
    is_learnt = has_span = false;
    return 0.0;
}

/// The lag with which the tool keeps its speed, if that is possible. `passed_s`: since the last arrival; `moved`: since the last reading, in m.
double MeasuredTime::lagByMotion (double passed_s, double moved) noexcept
{
    if (! (period > 0.0)) return 0.0;
    const double since = passed_s + lag, expected = velocity.norm() * passed_s;   // since the last reading was measured
    const bool was_silent = passed_s > silence * period;
    is_late = is_late ? moved > much_more * expected : was_silent && moved < much_less * expected;
    const double most = is_late ? since - std::min (period, passed_s) : std::min (period, since);
    const double elapsed = moved < velocity.norm() * since ? moved / velocity.norm() : since;
    const double late = std::clamp (since - elapsed, 0.0, most);
    return is_late ? late : late + to_middle * (std::min (0.5 * period, most) - late);
}

double MeasuredTime::operator() (double passed_on_clock_s, double arrived_s, const Vec3& position) noexcept
{
    if (! has_one)
    {
        has_one = true;
        now = arrived_s;
        last = position;
        return 0.0;
    }
    const double passed = std::max (0.0, arrived_s - now);
    now += passed;
    clock += passed_on_clock_s;
    offset += drift * passed;
    const Vec3 moved = position - last;
    last = position;

    double late = lagByMotion (passed, moved.norm());
    if (is_timed && is_learnt) late = lagByClock();
    const bool is_on_time = is_learnt ? late < 0.5 * std::max (period, 1e-3) : ! is_late && (period == 0.0 || passed < silence * period);
    if (is_timed) learnRate (is_on_time, late);
    if (velocity.norm() < slow) late = 0.0;
    late = std::clamp (late, 0.0, passed + lag);
    const double elapsed = passed + lag - late;
    lag = late;
    velocity += (moved - elapsed * velocity) / (tau + elapsed);
    return lag;
}

}   // namespace tactus::host::hid
