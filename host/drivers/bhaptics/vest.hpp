// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_device.h>

namespace tactus::host
{

inline constexpr auto usual_player = "localhost:15881";   ///< where bHaptics Player is unless the person says otherwise

/// The device driver `bhaptics`: vests, through bHaptics Player. docs/known_devices.md describes its keys: port, channels, full_force, rate.
extern const tactus_device_driver bhaptics_driver;

/// The same driver, which waits 300 times longer for the Player before it gives it up: for tests on busy computers.
extern const tactus_device_driver patient_bhaptics_driver;

}   // namespace tactus::host
