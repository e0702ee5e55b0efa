// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile_fields.hpp>

namespace tactus::host::hid
{

/// How the device's axes lie in ours: ["y", "-x", "z"] (x right is the device's y …), or three rows of a rotation.
Mat3 readAxes (ProfileFields& profile);

/// {"linear": …}, {"serial": …} or {"five_bar": …}; nothing is Direct.
KinematicsModel readKinematics (ProfileFields& profile);

}   // namespace tactus::host::hid
