// SPDX-License-Identifier: MIT
#pragma once

#include "trial_run.hpp"

#include <optional>
#include <span>

namespace tactus::host
{

/// The mechanics of a tool that nothing touched while it was pushed: mass in kg, damping in N s/m, Coulomb friction in N.
struct FreeMotion
{
    double mass = 0.0, damping = 0.0, friction = 0.0;
};

/// The mechanics that explain a push along an axis from rest. `period_s`: of the rows. Empty if the tool hardly moved, or moved in another way, as in a hand.
std::optional<FreeMotion> freeMotionOf (std::span<const TrialRow>, int axis, double period_s);

}   // namespace tactus::host
