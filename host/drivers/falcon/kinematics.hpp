// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/geometry/rotation.hpp>

#include <array>
#include <optional>

namespace tactus::host::falcon
{

/// The three legs of the Falcon, in its own axes: x right, y up, z away from the base, in m. Lengths and angles are those of libnifalcon, whose equations
/// come from R. E. Stamper's thesis (1997). The solution and its derivative do not come from there.
class Kinematics
{
public:
    /// The angles of the thighs from the counts of the encoders, in rad.
    static Vec3 anglesOf (const std::array<int, 3>& counts);

    /// The place of the grip for these angles, by Newton's method, to far less than 1 nm. Empty if there is no such place.
    std::optional<Vec3> placeOf (const Vec3& angles);

    /// The torques of the motors, in N m, that give this force on the grip at the last place.
    Vec3 torquesOf (const Vec3& force) const { return moves.transpose() * force; }

private:
    Mat3 moves = Mat3::Zero();   // of the place with each angle, by columns, in m/rad
};

}   // namespace tactus::host::falcon
