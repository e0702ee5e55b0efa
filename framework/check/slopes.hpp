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
/// nanometre along each axis, to both sides. The difference between the two copies is the response to the shift alone: vibrations,
/// noise and sounds are the same in both. Nodes that play when they are hit are silent, because they respond to events and not to
/// the position.
struct SlopeWork
{
    std::size_t role = 0;
    std::size_t places = 0;                ///< number of places where slopes are measured, spread evenly along the motion
    std::int64_t longest_delay = 0;        ///< of the compiled paths of the role, in ticks
    std::vector<std::size_t> without {};   ///< nodes that are silent
};

/// Also computes `directions`, as described above.
std::vector<Slope> measureSlopes (const Subject&, const HandMotion&, const SlopeWork&, Directions& directions);

}   // namespace tactus::check
