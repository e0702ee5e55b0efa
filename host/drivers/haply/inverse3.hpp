// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_device.h>

namespace tactus::host
{

inline constexpr auto usual_inverse3_service = "localhost:10001";   ///< where it is unless the person says otherwise

/// The device driver `haply`: Haply's Inverse3 and VerseGrip, through the service of their maker. docs/known_devices.md describes its keys: port,
/// device_id, grip, spelling.
extern const tactus_device_driver haply_driver;

/// The same driver, which waits 300 times longer for the service before it gives it up: for tests on busy computers.
extern const tactus_device_driver patient_haply_driver;

}   // namespace tactus::host
