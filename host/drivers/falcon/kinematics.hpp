// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>

namespace tactus::host::falcon
{

using Triple = std::array<double, 3>;

/// The three legs of the Falcon, in its own axes: x right, y up, z away from the base, in m. Lengths and angles are those of libnifalcon, whose equations
/// come from R. E. Stamper's thesis (1997). The solution and its derivative do not come from there.
class Kinematics
{
public:
    /// The angles of the thighs from the counts of the encoders, in rad.
    static Triple anglesOf (const std::array<int, 3>& counts);

    /// The place of the grip for these angles, by Newton's method, to far less than 1 nm. Empty if there is no such place.
    std::optional<Triple> placeOf (const Triple& angles);

    /// The torques of the motors, in N m, that give this force on the grip at the last place.
    Triple torquesOf (const Triple& force) const;

private:
    std::array<Triple, 3> moves {};   // of the place with each angle, in m/rad
};

}   // namespace tactus::host::falcon
