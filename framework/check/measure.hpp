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

/// The response of the force to a small displacement at one point of the motion. Each number is the largest response to a displacement in any
/// direction.
struct Slope
{
    double t_s = 0.0;                 ///< time since the start of the motion
    Vec3 position = Vec3::Zero();     ///< m
    Vec3 force = Vec3::Zero();        ///< on the tool, at rest, in N
    double brake = 0.0;               ///< damping of the device's brake there, in N s/m
    double stiffness = 0.0;           ///< sigma: force per displacement once the force has settled, in N/m
    double lag = 0.0;                 ///< force that is missing because it comes late, integrated over time, per displacement, in N s/m
    double damping = 0.0;             ///< |b|: excess force while it settles, integrated over time, per displacement, in N s/m
    std::vector<double> by_node {};   ///< by node number: the largest response of the node's own forces, in N/m
    /// By node number: in which directions the node's own force changes, J J^T in N^2/m^2, where J is the Jacobian of this force. A friction that depends on
    /// the load of a wall feels a displacement towards the wall, but its force is along the surface. Of a node whose forces are no vectors, or
    /// are turned before they reach the motor: J^T J, the directions in which it feels a displacement.
    std::vector<Eigen::Matrix3d> pulls {};
    /// The force that pulls back after a step of the tool, along the step, tick by tick, in N/m: for a step in the steepest direction, and for
    /// one in the direction of the largest excess, if that is another one. Empty if one of them cannot be measured, as if sections do not run
    /// on every tick.
    std::vector<std::vector<double>> responses {};
};

/// A matrix of slopes. How it gets its memory does not depend on the flags of the compiler, so a program may free what the library has made.
using Jacobian = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::DontAlign>;

/// The response of the forces of all roles to small displacements of all roles at one point of the motion. Each matrix has three rows and three
/// columns for each role, in the order of Demand::roles: a row for each component of a force, a column for each component of a displacement. A
/// positive number pulls the tool back.
struct Linked
{
    double t_s = 0.0;
    Jacobian settled {};   ///< force per displacement once the force has settled, in N/m
    Jacobian late {};      ///< force that is missing because it comes late, integrated over time, per displacement, in N s/m
    Jacobian excess {};    ///< excess force while it settles, integrated over time, per displacement, in N s/m
    /// The force after a step of the tools, tick by tick, in N/m; the last one lasts. Empty if it takes more than 64 ticks, or if sections do not
    /// run on every tick.
    std::vector<Jacobian> responses {};
    std::vector<double> by_node {};   ///< as in Slope: the largest response over all roles
    bool is_smooth = true;            ///< true if opposite displacements have opposite responses; false for friction
};

/// A force that steps at a place, like that of a relay.
struct Jump
{
    std::string role;                     ///< the role whose force steps most
    std::optional<std::size_t> node {};   ///< the node whose own force steps most
    double t_s = 0.0;
    Vec3 position = Vec3::Zero();   ///< m
    double force = 0.0;             ///< how far the force steps, in N; half of that if it steps across the movement
};

/// The demands of a graph on the device of one role.
struct RoleDemand
{
    std::string role;
    std::string axis {};                          ///< name of an axis of the device in addition to its tool, which is measured along x; empty: the tool
    std::vector<Slope> slopes {};                 ///< along the motion; empty if the role has no force or no position
    std::vector<Slope> nominal {};                ///< the same with the textures silenced; empty if there are none
    std::int64_t longest = 0;                     ///< longest delay of the compiled paths from the role's sources to its sinks, in ticks
    double peak_force = 0.0;                      ///< N
    double fastest_force = 0.0;                   ///< largest change of force from tick to tick, in N/s
    double speed = 0.0;                           ///< largest speed of the tool, in m/s
    std::vector<std::string> others {};           ///< efforts besides force, brake and measured axes: torques, signals …
    std::vector<std::string> claims_nothing {};   ///< paths of the nodes between hand and motor that do not claim to be passive, as they are wired here
    double claimed_stiffness = 0.0;               ///< sum of what the others claim, in N/m
    double claimed_damping = 0.0;                 ///< the same, in N s/m
    double dampers = 0.0;                         ///< sum of the damping that all nodes between hand and motor claim, however they are wired, in N s/m
    double given = 0.0;                           ///< most energy given by the graph along the motion beyond what it took before, in J, without players
};

/// A contact that stretches a little before it slides: any node with a param d_max in m, and deform.surface.
struct Stretch
{
    /// The param that decides how stiff it is.
    enum class Softer
    {
        unknown,
        d_max,
        stiffness   ///< of its own, so that d_max has no effect on it
    };

    std::size_t node = 0;
    std::string role;
    double d_max = 0.0;   ///< the shortest stretch at which it slides while at least half of its largest drag is felt, in m
    double teeth = 0.0;   ///< length of the teeth of stick-slip, in m; 0 without stick-slip
    double speed = 0.0;   ///< largest speed of the tool while at least half of the largest drag is felt, in m/s
    Softer softer = Softer::unknown;
};

/// A wall of hold.deadbeat. It computes its force two ticks ahead for a known mass, so it has no slope that a condition could judge.
struct Deadbeat
{
    std::size_t node = 0;
    std::string role;
    double mass = 0.0;                        ///< the mass that the node assumes, in kg; 0: that of the device
    double damping = 0.0;                     ///< of this mass, in N s/m; 0: that of the device
    double stiffness = 0.0;                   ///< N/m
    double delay = 0.0;                       ///< the delay that the node assumes, in ticks
    std::int64_t shortest = 0, longest = 0;   ///< delays of the compiled paths from the role's sources to its sinks, in ticks
};

/// A node that claims a spatial frequency and whose force the hand felt.
struct Texture
{
    std::size_t node = 0;
    std::string role;
    double spatial_frequency = 0.0;   ///< k, in 1/m
    double amplitude = 0.0;           ///< A: largest part of the role's force that the node causes, in N
    double slope = 0.0;               ///< largest slope of that part: 2 pi A k, or what the node claims, in N/m
    double speed = 0.0;               ///< v: largest speed across the texture while it was felt, in m/s
};

/// A node between a source and a sink of a role whose force the hand did not feel, so that nothing could be measured.
struct Unreached
{
    std::size_t node = 0;
    std::string role;
    bool renders_texture = false;   ///< false: it has a stretch at which it slides
};

struct MeasuredNode
{
    std::string path;
    std::string type;
};

/// The demands of a graph on its devices.
struct Demand
{
    double rate_hz = 0.0;
    double lasts_s = 0.0;   ///< duration of the motion
    std::vector<RoleDemand> roles {};
    double given_together = 0.0;     ///< RoleDemand::given of all roles together
    std::vector<Linked> linked {};   ///< along the motion; empty if no force depends on a position
    std::vector<Jump> jumps {};      ///< that the motion crosses
    std::vector<Stretch> stretches {};
    std::vector<Deadbeat> deadbeats {};
    std::vector<Texture> textures {};
    std::vector<Unreached> unreached {};
    std::vector<std::size_t> players {};     ///< numbers of the nodes that play by themselves, whatever the tools do, such as an lfo
    std::vector<std::size_t> modulated {};   ///< numbers of those that play by themselves, and that a device turns up or down
    std::vector<MeasuredNode> nodes {};      ///< by node number
};

/// The number of points and ticks with which a graph is measured. More points take longer.
struct Thoroughness
{
    std::size_t places = 96;         ///< number of points at which slopes are measured: see chooseSpots()
    std::optional<double> at_s {};   ///< measure slopes only at this time of the motion, in s
    /// About how many ticks measure() may take in all. With fewer than it would take, it measures at fewer places, but at least 8, walks the path
    /// in longer steps, and measures only the steepest textures each on its own; the others count with the force of their node.
    std::size_t ticks = std::numeric_limits<std::size_t>::max();
    std::size_t threads = 1;   ///< that measure() may use; the result does not depend on them
};

/// The number of ticks of a graph that take about 3 s if its nodes are as fast as most are. Depends only on which nodes there are.
std::size_t affordableTicks (const Plan&);

/// Measures a graph along a motion that was recorded at the same rate. The result is a pure function of the arguments. Takes about
/// 150,000 ticks of the graph for each role, twice that if there are textures, up to four times that if sections do not run on
/// every tick, 40,000 ticks to choose the points, and one run along the motion for each texture; fewer if Thoroughness::ticks says so. The graph
/// must compile without errors, and the motion must not diverge (see divergence()). Throws Stopped if the subject is stopped. [any thread, as long
/// as no other thread uses the assets]
Demand measure (const Subject&, const HandMotion&, const Thoroughness& = {});

}   // namespace tactus::check
