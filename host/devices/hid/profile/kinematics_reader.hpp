// SPDX-License-Identifier: MIT
#pragma once

#include "profile_fields.hpp"

#include <optional>

namespace tactus::host::hid
{

/// The matrix that three axes such as ["y", "-x", "z"] mean (our x is the device's y …), or three rows of numbers. Empty unless the axes have the
/// length 1 and are perpendicular, to 1e-9. The determinant is -1 if they mirror.
std::optional<Mat3> axesOf (const Json&);

/// Reads the orientation of the device's axes: ["y", "-x", "z"] (our x is the device's y …), or three rows of a rotation.
Mat3 readAxes (ProfileFields& profile);

/// Reads {"linear": …}, {"serial": …} or {"five_bar": …}; Direct if the profile has no kinematics.
KinematicsModel readKinematics (ProfileFields& profile);

}   // namespace tactus::host::hid
