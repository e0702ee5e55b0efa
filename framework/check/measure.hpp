// SPDX-License-Identifier: MIT
#pragma once

/// Measures what a graph asks of the devices of its roles. The graph is compiled, and its tools are moved along a recorded motion of
/// hands: nothing is assumed about the nodes beyond their datasheets and claims. judge.hpp compares the result with a device.

#include "hand_motion.hpp"

#include <tactus/kit/vec3.hpp>
#include <tactus/text/message.hpp>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace tactus::check
{

/// How the force responds to a small displacement at one place of the motion. Norms of 3 by 3 matrices: the largest response to a
/// displacement in any direction.
struct Slope
{
    double t_s = 0.0;                 ///< when the hand was there
    Vec3 position = Vec3::Zero();     ///< m
    double stiffness = 0.0;           ///< sigma: force per displacement once the force has settled, in N/m
    double lag = 0.0;                 ///< what comes late: the missing force, integrated over time, per displacement, in N s/m
    double damping = 0.0;             ///< |b|: the force in excess while it settles, integrated over time, per displacement, in N s/m
    std::vector<double> by_node {};   ///< the slope of the own forces of each node, in N/m; by number of the node
};

/// What a role's device is asked to do.
struct RoleDemand
{
    std::string role;
    std::vector<Slope> slopes {};     ///< along the motion; empty if the role has no force or no position
    std::vector<Slope> nominal {};    ///< the same without the textures; empty if there are none
    std::int64_t longest = 0;         ///< longest delay of the compiled paths from the role's sources to its sinks, in ticks
    double peak_force = 0.0;          ///< N
    double fastest_force = 0.0;       ///< largest change of force from tick to tick, in N/s
    double speed = 0.0;               ///< largest speed of the tool, in m/s
    bool has_other_efforts = false;   ///< torques, axes or signals, which are not judged
};

/// A node whose friction gives by a small stretch before it slides: one that has a param d_max in m.
struct Stretch
{
    std::size_t node = 0;
    std::string role;
    double d_max = 0.0;   ///< the smallest one while the node gave a force, in m
};

/// A node that renders a spatial frequency, as its claims say, and that the hand felt.
struct Texture
{
    std::size_t node = 0;
    std::string role;
    double spatial_frequency = 0.0;   ///< k, in 1/m
    double amplitude = 0.0;           ///< A: largest part of the role's force that the node causes, in N
    double slope = 0.0;               ///< largest slope of that part: 2 pi A k, or what the node claims, in N/m
    double speed = 0.0;               ///< v: largest speed across the texture while it was felt, in m/s
};

struct MeasuredNode
{
    std::string path;
    std::string type;
};

/// What a graph asks of its devices.
struct Demand
{
    double rate_hz = 0.0;
    double lasts_s = 0.0;   ///< of the motion
    std::vector<RoleDemand> roles {};
    std::vector<Stretch> stretches {};
    std::vector<Texture> textures {};
    std::vector<MeasuredNode> nodes {};   ///< by number
};

/// How finely a graph is measured. More places take longer.
struct Thoroughness
{
    std::size_t places = 96;   ///< where slopes are measured, evenly along the motion
};

/// Measures a graph along a motion that was recorded at the same rate. The result is a pure function of the arguments. Takes about
/// 60,000 ticks of the graph, twice that if it has textures, plus the length of the motion for each texture. The graph must compile
/// without errors. [any thread, as long as no other thread uses the assets]
Demand measure (const Subject&, const HandMotion&, const Thoroughness& = {});

}   // namespace tactus::check
