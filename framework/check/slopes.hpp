// SPDX-License-Identifier: MIT
#pragma once

#include "bench.hpp"
#include "measure.hpp"

namespace tactus::check
{

/// For each node, the directions in which its own forces change with the position of a role: the sum of J^T J over all places, where
/// J is the Jacobian of the forces.
using Directions = std::vector<Eigen::Matrix3d>;

/// Measures the slopes of a role along the motion.
///
/// Two copies of the graph run side by side. At each place, the motion halts in both, and the tool of one copy is shifted by a
/// nanometre along each axis, to both sides. What differs between the two copies is the response to the shift alone: vibrations,
/// noise and sounds are the same in both. Nodes that play when they are hit are silent: they answer an event, not a place.
struct SlopeWork
{
    std::size_t role = 0;
    std::size_t places = 0;                ///< where slopes are measured, evenly along the motion
    std::int64_t longest_delay = 0;        ///< of the compiled paths of the role, in ticks
    std::vector<std::size_t> without {};   ///< nodes that have no effect
};

/// `directions` is filled as described above.
std::vector<Slope> measureSlopes (const Subject&, const HandMotion&, const SlopeWork&, Directions& directions);

}   // namespace tactus::check
