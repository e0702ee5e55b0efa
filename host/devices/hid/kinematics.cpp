// SPDX-License-Identifier: MIT
#include "kinematics.hpp"

#include <tactus/kit/math/math.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

namespace tactus::host::hid
{
namespace
{
using Pose = Kinematics::Pose;

/// The distance from singularity, 0…1, sets how much of a force is rendered: all of it above `firm`, none below `weak`.
/// So the force fades instead of stopping abruptly when the hand crosses a singular pose.
constexpr double weak = 0.02, firm = 0.1;

void fade (Pose& pose, double regularity) noexcept
{
    pose.strength = std::clamp ((regularity - weak) / (firm - weak), 0.0, 1.0);
    if (pose.strength < 1.0) pose.problem = PoseProblem::singular;
}

Pose problem (PoseProblem what) noexcept
{
    Pose pose;
    pose.jacobian = Mat3::Zero();
    pose.strength = 0.0;
    pose.problem = what;
    return pose;
}

double jointOf (const Drive& d, double counts) noexcept { return d.offset + 2.0 * std::numbers::pi * counts / d.counts_per_turn * d.ratio; }
double countsOf (const Drive& d, double joint) noexcept { return (joint - d.offset) / d.ratio * d.counts_per_turn / (2.0 * std::numbers::pi); }

std::span<const Drive> drivesOf (const KinematicsModel& model) noexcept
{
    if (const auto* arm = std::get_if<SerialArm> (&model)) return arm->drives;
    if (const auto* bar = std::get_if<FiveBar> (&model)) return bar->drives;
    return {};
}

// The pose of each mechanism.

Pose poseOf (const DirectKinematics&, const Vec3& q) noexcept
{
    Pose pose;
    pose.position = q;
    return pose;
}

Pose poseOf (const LinearMap& map, const Vec3& q) noexcept
{
    Pose pose;
    pose.position = map.matrix * q + map.origin;
    pose.jacobian = map.matrix;
    return pose;
}

Pose poseOf (const SerialArm& arm, const Vec3& q) noexcept
{
    const auto [sa, ca] = math::sinCos (q[0]);
    const auto [sb, cb] = math::sinCos (q[1]);
    const auto [sc, cc] = math::sinCos (q[2]);
    const double la = arm.links[0], lb = arm.links[1], lc = arm.links[2];
    const double reach = lb * sb + lc * sc;

    Pose pose;
    pose.position = Vec3 { ca * reach, sa * reach, la + lb * cb - lc * cc } - arm.origin;
    pose.jacobian << -sa * reach, ca * lb * cb, ca * lc * cc,
        ca * reach, sa * lb * cb, sa * lc * cc,
        0.0, -lb * sb, lc * sc;

    // Singular if the links are in line (the tool cannot be pushed along them), or if the tool is above or below the column.
    const double in_line = std::abs (sb * cc + cb * sc);
    const double over_column = std::abs (reach) / (lb + lc);
    fade (pose, std::min (in_line, over_column));
    return pose;
}

Pose poseOf (const FiveBar& bar, const Vec3& q) noexcept
{
    using Vec2 = Eigen::Vector2d;
    const auto [right_sine, right_cosine] = math::sinCos (q[0]);
    const auto [left_sine, left_cosine] = math::sinCos (q[1]);
    const Vec2 right_way { right_cosine, right_sine }, left_way { left_cosine, left_sine };
    const Vec2 right = bar.links[0] * right_way;
    const Vec2 left = Vec2 { -bar.base, 0.0 } + bar.links[3] * left_way;

    // The tool is at the intersection of two circles around the elbows, on the side away from the pivots.
    const Vec2 between = left - right;
    const double far = between.norm(), r = bar.links[1], l = bar.links[2];
    if (! (far > 0.0) || far > r + l || far < std::abs (r - l)) return problem (PoseProblem::unreachable);

    const double along = (r * r - l * l + far * far) / (2.0 * far);
    const double height = std::sqrt (std::max (0.0, r * r - along * along));
    const Vec2 way = between / far;
    const Vec2 tool = right + along * way + height * Vec2 { way.y(), -way.x() };

    // The passive links keep their lengths: (tool - elbow) · (d tool - d elbow) = 0 for both.
    const Vec2 to_right = tool - right, to_left = tool - left;
    const double area = to_right.x() * to_left.y() - to_right.y() * to_left.x();
    const double by_right = bar.links[0] * (to_right.y() * right_way.x() - to_right.x() * right_way.y());
    const double by_left = bar.links[3] * (to_left.y() * left_way.x() - to_left.x() * left_way.y());

    Pose pose;
    pose.position = Vec3 { tool.x(), tool.y(), 0.0 } - bar.origin;
    pose.jacobian = Mat3::Zero();
    const double regularity = std::abs (area) / (r * l);
    fade (pose, regularity);
    if (pose.strength == 0.0) return pose;

    pose.jacobian.col (0).head<2>() = by_right / area * Vec2 { to_left.y(), -to_left.x() };
    pose.jacobian.col (1).head<2>() = by_left / area * Vec2 { -to_right.y(), to_right.x() };
    return pose;
}

}   // namespace

std::string_view describe (PoseProblem problem) noexcept
{
    switch (problem)
    {
    case PoseProblem::not_finite:
        return "a joint angle is not finite";
    case PoseProblem::unreachable:
        return "the links cannot meet";
    case PoseProblem::singular:
        return "a singular pose";
    default:
        return "none";
    }
}

Kinematics::Kinematics (KinematicsModel m) : model (std::move (m)) {}

Vec3 Kinematics::joints (const Vec3& counts) const noexcept
{
    Vec3 q = counts;
    const auto drives = drivesOf (model);
    for (std::size_t i = 0; i < drives.size(); ++i)
        q[static_cast<int> (i)] = jointOf (drives[i], counts[static_cast<int> (i)]);
    return q;
}

Vec3 Kinematics::counts (const Vec3& q) const noexcept
{
    Vec3 c = q;
    const auto drives = drivesOf (model);
    for (std::size_t i = 0; i < drives.size(); ++i)
        c[static_cast<int> (i)] = countsOf (drives[i], q[static_cast<int> (i)]);
    return c;
}

Kinematics::Pose Kinematics::pose (const Vec3& q) const noexcept
{
    if (! isFinite (q)) return problem (PoseProblem::not_finite);
    const Pose pose = std::visit ([&] (const auto& m) { return poseOf (m, q); },
                                  model);
    const bool finite = isFinite (pose.position) && isFinite (pose.jacobian.sum());
    return finite ? pose : problem (PoseProblem::not_finite);
}

Vec3 Kinematics::torques (const Pose& pose, const Vec3& force) noexcept
{
    const Vec3 torques = pose.strength * (pose.jacobian.transpose() * force);
    return isFinite (torques) ? torques : Vec3::Zero();
}

namespace
{
double currentOf (const Drive& d, double torque) noexcept { return torque * (d.ratio / d.torque_constant); }
}   // namespace

double Kinematics::share (const Vec3& torques) const noexcept
{
    double share = 1.0;
    const auto drives = drivesOf (model);
    for (std::size_t i = 0; i < drives.size(); ++i)
        if (const double current = std::abs (currentOf (drives[i], torques[static_cast<int> (i)])); current > drives[i].max_current)
            share = std::min (share, drives[i].max_current / current);
    return share;
}

Vec3 Kinematics::motors (const Vec3& torques) const noexcept
{
    Vec3 currents = torques;
    const auto drives = drivesOf (model);
    for (std::size_t i = 0; i < drives.size(); ++i)
        currents[static_cast<int> (i)] = currentOf (drives[i], torques[static_cast<int> (i)]);
    return finiteOrZero (Vec3 { share (torques) * currents });
}

}   // namespace tactus::host::hid
