// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"

#include <string_view>

namespace tactus::host::hid
{

enum class PoseProblem
{
    none,
    not_finite,
    unreachable,   ///< the links cannot meet at these angles: wrong profile, or a counter that lost steps
    singular       ///< the tool cannot be pushed in some direction here; the effort fades to zero
};

/// Describes a problem, as in "the links cannot meet".
std::string_view describe (PoseProblem) noexcept;

/// Maps encoder counts to the pose of the tool, and a force on the tool to motor currents, all in the device's own axes.
/// Every pose gives finite numbers. [any thread that owns it]
class Kinematics
{
public:
    /// q: joint angles in rad, or the counted values of a linear map.
    struct Pose
    {
        Vec3 position = Vec3::Zero();       ///< m
        Mat3 jacobian = Mat3::Identity();   ///< dp/dq
        PoseProblem problem = PoseProblem::none;
        double strength = 1.0;   ///< the fraction of a force that can be rendered, 0…1; 0 at a singular pose
    };

    explicit Kinematics (KinematicsModel);

    Vec3 joints (const Vec3& counts) const noexcept;
    Vec3 counts (const Vec3& joints) const noexcept;

    Pose pose (const Vec3& joints) const noexcept;

    /// tau = transpose (J) F at the joints, in N m, or in the matching unit of a linear map; 0 for a force that is not
    /// finite.
    static Vec3 torques (const Pose&, const Vec3& force) noexcept;

    /// Motor currents in A for joint torques. If one motor saturates, all are reduced, which keeps the direction of the
    /// force. For direct and linear devices, the torques themselves.
    Vec3 motors (const Vec3& torques) const noexcept;

    /// The share of the given torques, 0…1, that motors() can render.
    double share (const Vec3& torques) const noexcept;

private:
    KinematicsModel model;
};

}   // namespace tactus::host::hid
