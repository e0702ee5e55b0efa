// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_device.h>

namespace tactus::host::openhaptics
{

/// The driver for the arms of 3D Systems (Touch, Touch X, Phantom). See docs/known_devices.md.
extern const tactus_device_driver driver;

}   // namespace tactus::host::openhaptics
