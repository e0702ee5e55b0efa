// SPDX-License-Identifier: MIT
#include "effort_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
/// The largest change of an effort in this time. Without a limit it is unlimited, even if no time has passed.
double stepOf (double slew, double passed_s) noexcept { return slew == GuardLimits::none ? slew : slew * passed_s; }

/// Moves towards what is wanted, within `most`, and by no more than `step`. True if the step is too short.
bool approach (Vec3& now, const Vec3& wanted, double most, double step) noexcept
{
    Vec3 to = finiteOrZero (wanted);
    if (const double size = to.norm(); size > most) to *= most / size;
    const Vec3 change = to - now;
    const double size = change.norm();
    const bool is_short = size > step;
    now = is_short ? Vec3 (now + step / size * change) : to;
    return is_short;
}

bool approach (Channels& now, const Channels& wanted, double most, double step) noexcept
{
    bool is_short = false;
    for (int i = std::max (wanted.size(), now.size()) - 1; i >= 0; --i)
    {
        const double to = std::clamp (finiteOrZero (wanted[i]), -most, most), next = std::clamp (to, now[i] - step, now[i] + step);
        now.set (i, next);
        is_short = is_short || next != to;
    }
    return is_short;
}
}   // namespace

void EffortLimiter::tighten (double force, double torque, double axis) noexcept
{
    limits.max_slew = std::min (limits.max_slew, force);
    limits.max_torque_slew = std::min (limits.max_torque_slew, torque);
    limits.max_axis_slew = std::min (limits.max_axis_slew, axis);
}

const Effort& EffortLimiter::operator() (const Effort& wanted, double passed_s) noexcept
{
    const double passed = isFinite (passed_s) ? std::max (0.0, passed_s) : 0.0;
    const bool force = approach (last.force, wanted.force, limits.max_force, stepOf (limits.max_slew, passed));
    const bool torque = approach (last.torque, wanted.torque, limits.max_torque, stepOf (limits.max_torque_slew, passed));
    const bool axes = approach (last.axes, wanted.axes, limits.max_axis_effort, stepOf (limits.max_axis_slew, passed));
    const bool signals = approach (last.signals, wanted.signals, limits.max_signal, stepOf (limits.max_signal_slew, passed));
    behind = force || torque || axes || signals;
    return last;
}

void EffortLimiter::forget() noexcept
{
    last = {};
    behind = false;
}

}   // namespace tactus::host
