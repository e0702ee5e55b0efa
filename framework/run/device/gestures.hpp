// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>

#include <span>
#include <string_view>

namespace tactus
{

/// The motion of a hand as a function of time, in metres in device axes, with the surface at z = 0 and the hand above it.
///
/// Every gesture starts and ends at rest, above the surface and at the same place, so that it can be repeated indefinitely. In
/// between, its acceleration is continuous, like the acceleration of a hand. Movements have minimum jerk (Flash & Hogan 1985),
/// which is how people reach: slow, fast, slow, with a peak of 15/8 of the mean speed.
struct Gesture
{
    std::string_view id;
    std::string_view about;        ///< what the hand does, in one sentence
    double duration_s;             ///< time until the gesture repeats
    Vec3 (*position) (double t);   ///< in m, at t in s; constant before 0 and after duration_s
};

/// All gestures, in the order in which lists show them.
std::span<const Gesture> gestures() noexcept;

/// Returns null if there is no gesture with that name.
const Gesture* findGesture (std::string_view id) noexcept;

}   // namespace tactus
