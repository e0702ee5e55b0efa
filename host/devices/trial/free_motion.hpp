// SPDX-License-Identifier: MIT
#pragma once

#include "trial_run.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// The values between which a number is, by a measurement.
struct Between
{
    double least = 0.0, most = 0.0;
};

/// The mechanics of a tool that nothing holds: mass in kg, damping in N s/m, Coulomb friction in N.
struct ToolMechanics
{
    Between mass, damping, friction;
};

/// A push of a tool that nothing holds, from rest, and the motion after it.
struct FreePush
{
    Vec3 direction = Vec3::UnitX();
    std::vector<TrialRow> rows;
};

inline constexpr int free_pushes = 4;

/// The mechanics that explain each of four pushes: m x'' + B x' + c = F while the tool moves in the direction of the push. Each push gives numbers of its own.
/// Their spread gives the interval (99 %, Student), widened by what the numbers change if each force came up to 1.25 `delay_s` later, or if each reading were
/// newer than it says by 1.25 times the largest age. Empty, with the reason in `why`, if a push cannot be used, if a hand, a spring or a stop takes part, or if
/// the whole interval of the friction is below 0.
std::optional<ToolMechanics> mechanicsOf (std::span<const FreePush>, double delay_s, std::string& why);

}   // namespace tactus::host
