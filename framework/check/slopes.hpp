// SPDX-License-Identifier: MIT
#pragma once

#include "measure.hpp"
#include "spots.hpp"

#include <span>

namespace tactus::check
{

/// For each node, the directions in which its own forces change with the position of a role: the sum of J^T J over all places, where
/// J is the Jacobian of the forces.
using Directions = std::vector<Eigen::Matrix3d>;

struct SlopeWork
{
    std::vector<Spot> spots {};            ///< where slopes are measured, in the order of the motion
    std::int64_t longest_delay = 0;        ///< of the compiled paths, in ticks
    std::vector<std::size_t> without {};   ///< nodes that are silent
    bool looks_for_jumps = true;
};

struct Slopes
{
    std::vector<std::vector<Slope>> by_role {};   ///< by role, then place: the spots, and the places that were narrowed down
    std::vector<Linked> linked {};                ///< by place
    std::vector<Jump> jumps {};
    std::vector<Directions> directions {};   ///< by role
};

/// Measures the slopes of all roles.
///
/// Two copies of the graph run side by side (Pair). At each spot, the motion halts in both, and the tool of each role in one copy is
/// shifted by a nanometre along each axis, in both directions. Nodes that play when they are hit are silent, because they respond to
/// events and not to the position.
///
/// If the forces change by more along the spot than the slope in its middle explains, the place of the change is narrowed down to
/// 20 nm. The slope is then measured there, too. A change that remains over these 20 nm is a jump, unless it does not
/// repeat when the tools go back and forth.
///
/// Each work is measured as if it were the only one. The result does not depend on the number of threads that share them.
std::vector<Slopes> measureSlopes (const Subject&, const HandMotion&, std::span<const SlopeWork>, std::size_t threads);

}   // namespace tactus::check
