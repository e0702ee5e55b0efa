// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>
#include <tactus/run/guard.hpp>

#include <algorithm>

namespace tactus
{

/// Brings an effort of another time within these limits of size, keeping directions. One that is within them, but for rounding, keeps its bits.
inline void shorten (Effort& e, const GuardLimits& limits) noexcept
{
    constexpr double rounding = 1.0 + 1e-9;
    const auto within = [] (Vec3& v, double most) {
        const double size = math::hypot (v.x(), v.y(), v.z());
        if (size > most * rounding) v *= std::max (most, 0.0) / size;
    };
    const auto each = [] (Channels& all, double most) {
        for (int i = 0; i < all.size(); ++i)
            if (std::abs (all[i]) > most * rounding) all.set (i, std::copysign (std::max (most, 0.0), all[i]));
    };
    within (e.force, limits.max_force);
    within (e.torque, limits.max_torque);
    each (e.axes, limits.max_axis_effort);
    each (e.signals, limits.max_signal);
    if (e.brake > limits.max_brake * rounding) e.brake = std::max (limits.max_brake, 0.0);
}

}   // namespace tactus
