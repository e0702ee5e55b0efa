// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/device/sim.hpp>
#include <tactus/run/engine.hpp>

#include "support/sketch.hpp"

#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tactus::test
{

inline constexpr double pressing_n = 1.0;   // N

/// A tool at rest in the wall, a little off its equilibrium.
inline Simulation resting (Simulation sim, double stiffness)
{
    sim.hand_force = { 0, 0, -pressing_n };
    sim.position = { 0, 0, -1.02 * pressing_n / stiffness };
    return sim;
}

/// Where a tool has been.
struct Trail
{
    double lowest = 1e9, highest = -1e9, rise = 0.0, fall = 0.0;   // rise and fall: the longest ways up and down

    void to (double z)
    {
        lowest = std::min (lowest, z);
        highest = std::max (highest, z);
        rise = std::max (rise, z - lowest);
        fall = std::max (fall, highest - z);
    }

    double range() const { return highest > lowest ? highest - lowest : 0.0; }

    /// How far the tool swings. A tool that only creeps one way does not swing: if the force at one step of the sensor is F, a little above
    /// the friction f_f, the tool creeps to the next step at (F - f_f)/B, however slow that is.
    double swing() const { return std::min (rise, fall); }
};

inline rc::Gen<double> between (double min, double max)
{
    return rc::gen::map (rc::gen::inRange (0, 1'000'001), [=] (int i) { return min * std::pow (max / min, 1e-6 * i); });
}

/// The ranges of the positions in the third and in the fourth quarter of 60 000 ticks. In the first half, the slow swing of a tool that bends dies
/// away, which says nothing about the loop.
inline std::array<double, 2> lateRanges (const graph::Graph& graph, const Simulation& sim)
{
    constexpr int ticks = 60'000;
    SimulatedDevice device { sim };
    Engine engine { compile (graph, catalogue()).plan };
    engine.attach ("tip", device);
    std::array<Trail, 2> quarters;
    for (int k = 0; k < ticks; ++k)
    {
        engine.tick();
        if (2 * k >= ticks) quarters[4 * k >= 3 * ticks].to (engine.plan().roles()[0].state->reading.true_position.z());
    }
    return { quarters[0].range(), quarters[1].range() };
}

}   // namespace tactus::test
