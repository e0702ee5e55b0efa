// SPDX-License-Identifier: MIT
#pragma once

#include "bench.hpp"
#include "measure.hpp"
#include "slopes.hpp"

#include <cstddef>
#include <vector>

namespace tactus::check
{

/// A run of a whole graph along a motion.
struct RunAlong
{
    const Subject& subject;
    const HandMotion& motion;   ///< with axes
    const Forces& forces;
    const std::vector<std::vector<Vec3>>& velocities;   ///< of the tools, by role, then tick, in m/s
    const std::vector<Directions>& directions;          ///< by role, then node
    const std::vector<std::vector<bool>>& between;      ///< by role, then node: the nodes between its sources and its sinks
};

/// The nodes of a graph that render a spatial frequency.
class Textures
{
public:
    void find (const Plan& running);                      ///< call after the first tick of a run along the motion
    void poll (const Plan& running, std::size_t ticks);   ///< call after each tick. `ticks`: before this one

    bool areNone() const noexcept { return watched.empty(); }
    std::vector<std::size_t> nodes() const;

    /// Adds each texture that is felt to the demand, in a run without it. If a quarter of the ticks of `how` does not suffice for that, only the
    /// steepest ones are, and a last run is for all others. Textures that the hand did not feel are added to Demand::unreached.
    void addTo (Demand&, const RunAlong&, const Thoroughness& how) const;

private:
    /// The largest claims of a texture, and its largest force.
    struct Watched
    {
        std::size_t node;
        NodeForces forces;
        bool is_driven;         // a wire drives one of its params, so its claims can change during the run
        Claims claims {};       // the largest value of each claim
        double loudest = 0.0;   // largest force, in N

        double ownAmplitude() const noexcept;   // N
        double ownSlope (double amplitude) const noexcept;
        void poll (const Plan&, bool with_claims);
    };

    /// The work of addTo().
    class Adding;

    std::vector<Watched> watched {};
};

}   // namespace tactus::check
