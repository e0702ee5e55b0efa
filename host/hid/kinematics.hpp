// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>

#include <optional>
#include <string_view>

namespace tactus::host::hid
{

enum class PoseProblem
{
    none,
    not_finite,
    unreachable,   ///< the links cannot meet at these angles: a wrong profile, or a counter that lost its place
    singular       ///< the tool cannot be pushed in some direction here; the effort fades to nothing
};

/// "the links cannot meet"
std::string_view describe (PoseProblem) noexcept;

/// From what a device counts to where its tool is, and from a force on the tool to what its motors have to do, all in
/// the device's own axes. Total: no pose gives anything but finite numbers. [any thread that owns it]
class Kinematics
{
public:
    /// q are joint angles in rad or, of a linear map, what was counted.
    struct Pose
    {
        Vec3 position = Vec3::Zero();       ///< m
        Mat3 jacobian = Mat3::Identity();   ///< dp/dq
        PoseProblem problem = PoseProblem::none;
        double strength = 1.0;   ///< 1…0: how much of a force can be rendered; 0 at a singular pose
    };

    explicit Kinematics (KinematicsModel);

    Vec3 joints (const Vec3& counts) const noexcept;
    Vec3 counts (const Vec3& joints) const noexcept;

    Pose pose (const Vec3& joints) const noexcept;

    /// The joints at which the tool is there; nothing if it cannot be. Of a linear map without an inverse, nothing.
    std::optional<Vec3> jointsAt (const Vec3& position) const noexcept;

    /// tau = transpose (J) F, at the joints: N m, or what makes N m of a linear map's own units; 0 for a force that is
    /// not finite.
    static Vec3 torques (const Pose&, const Vec3& force) noexcept;

    /// Currents in A for torques at the joints. Where one motor cannot do it all give less, so that the direction of
    /// the force is kept. Of direct and linear devices, the torques themselves.
    Vec3 motors (const Vec3& torques) const noexcept;

private:
    KinematicsModel model;
};

}   // namespace tactus::host::hid
