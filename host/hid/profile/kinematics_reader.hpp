// SPDX-License-Identifier: MIT
#pragma once

#include "profile_fields.hpp"

namespace tactus::host::hid
{

/// Reads the orientation of the device's axes: ["y", "-x", "z"] (our x is the device's y …), or three rows of a rotation.
Mat3 readAxes (ProfileFields& profile);

/// Reads {"linear": …}, {"serial": …} or {"five_bar": …}; Direct if the profile has no kinematics.
KinematicsModel readKinematics (ProfileFields& profile);

}   // namespace tactus::host::hid
