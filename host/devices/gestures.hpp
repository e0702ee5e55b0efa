// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/list.hpp>

#include <span>
#include <string_view>

namespace tactus::host
{

/// What a hand does, as a function of time: metres in device axes, with the surface at z = 0 and the hand above it.
///
/// Every gesture starts and ends at rest, above the surface and at the same place, so that it can be repeated for
/// ever; in between its acceleration is continuous, as that of a hand is. Movements are of minimum jerk
/// (Flash & Hogan 1985), which is how people reach: slow, fast, slow, with a peak of 15/8 of the mean speed.
struct Gesture
{
    std::string_view id;
    std::string_view about;        ///< one sentence
    double duration_s;             ///< until it repeats
    Vec3 (*position) (double t);   ///< m, for t in s from 0 to duration_s; the ends hold outside
};

/// All of them, in the order in which they should be listed.
std::span<const Gesture> gestures() noexcept;

/// Null if there is none of that name.
const Gesture* findGesture (std::string_view id) noexcept;

}   // namespace tactus::host
