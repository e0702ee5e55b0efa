// SPDX-License-Identifier: MIT
#pragma once

#include "hand_motion.hpp"

#include <vector>

namespace tactus::check
{

/// A stretch of the motion in which slopes are measured, in ticks since the start. A fraction of a tick lies on the straight line
/// between the positions of two ticks.
struct Spot
{
    double from = 0.0, to = 0.0;

    double middle() const noexcept { return 0.5 * (from + to); }
};

/// The largest number of steps in which a path is walked, and the length of the shortest step, in m.
inline constexpr std::size_t most_steps = 20'000;
inline constexpr double shortest_step = 1e-5;

/// Chooses where slopes are measured, in the order of the motion. A third of the spots are spread evenly in time. For the others, the
/// path of all tools together is walked in small equal steps, and divided into stretches of equal length. In each stretch, the spot
/// is the step over which the forces change most. Two copies of the graph walk, one step apart, so that changes with time do not count.
/// Nodes in `without` are silent. Takes at most `steps` ticks of two graphs. [main thread]
std::vector<Spot> chooseSpots (const Subject&, const HandMotion&, std::size_t count, const std::vector<std::size_t>& without,
                               std::size_t steps = most_steps);

}   // namespace tactus::check
