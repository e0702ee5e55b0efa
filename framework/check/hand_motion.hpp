// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/node/device.hpp>
#include <tactus/plan/compile.hpp>
#include <tactus/text/message.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

namespace tactus::check
{

/// The graph under test. The catalogue, and the assets and services in the options, must outlive it.
struct Subject
{
    const graph::Graph& graph;
    const Catalogue& catalogue;
    CompileOptions options {};   ///< the rate, the assets, the values that take precedence over the file
    std::stop_token stop {};     ///< for measure(): once it is requested, measure() throws Stopped within a tick of the graph
};

/// Thrown by measure() because its Subject was stopped.
struct Stopped final
{
};

/// An axis of a device, in addition to its tool, that the graph both reads and pushes.
struct DrivenAxis
{
    std::string name;
    std::size_t owner = 0;      ///< the role, in the order of the plan
    int read = 0, pushed = 0;   ///< in Reading::axes and in Effort::axes
};

/// The readings of a role's device, one for each tick.
struct RoleMotion
{
    std::string role;
    DeviceLayout layout {};
    std::vector<Reading> readings {};    ///< one for each tick of the motion
    std::optional<DrivenAxis> axis {};   ///< withAxes(): the x of a position is that of the axis
};

/// The motion of all hands while a graph is measured.
struct HandMotion
{
    double rate_hz = 0.0;
    std::size_t ticks = 0;
    std::vector<RoleMotion> roles {};   ///< in the order of the plan's roles
};

/// The device that moves the hand of a role.
struct Hand
{
    std::string role;
    Device& device;
};

/// Runs the graph with these devices and keeps what they report. A role without a hand stays at the origin. The plan must not have
/// run yet. [main thread]
HandMotion recordMotion (std::shared_ptr<Plan>, std::span<const Hand>, std::size_t ticks);

/// The same motion at another rate: each tick has the reading of the last tick before its time, and a position on the straight line to the next one.
HandMotion atRate (const HandMotion&, double rate_hz);

/// The same motion, followed by one RoleMotion for each axis that the graph reads and pushes: an axis is measured like a tool that moves along x.
HandMotion withAxes (const HandMotion&, const Plan&);

/// The box that the tool of a role can reach, in m.
struct Reach
{
    std::string role;
    Vec3 min = Vec3::Zero(), max = Vec3::Zero();
};

/// The distance that a tool may move from its start if nothing is known about its reach, in m.
inline constexpr double farthest_m = 1.0;

/// An error (check/diverged) for each role whose tool ran away while the motion was recorded: one of its positions is not finite,
/// is further outside the role's reach than the diagonal of the reach, or, without a reach, is further from the start than
/// farthest_m. The slopes along such a motion mean nothing. [any thread]
Messages divergence (const HandMotion&, std::span<const Reach> = {});

/// Moves a tool through a box, for a device without a hand: a Lissajous curve that comes close to every point. It does not react to
/// forces. `lasts_s` is the time for the whole curve.
class SweepDevice final : public Device
{
public:
    SweepDevice (const Vec3& min_m, const Vec3& max_m, double lasts_s = 4.0) : min (min_m), max (max_m), lasts (lasts_s) {}

    void prepare (double dt_s) override;
    Reading read() noexcept override;
    void write (const Effort&) noexcept override {}
    double duration() const noexcept override { return lasts; }

private:
    Vec3 min, max;   // m
    double lasts, dt = 1e-3;
    std::size_t tick = 0;
};

}   // namespace tactus::check
