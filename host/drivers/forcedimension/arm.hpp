// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_device.h>

namespace tactus::host::forcedimension
{

/// The driver for the arms of Force Dimension. See docs/known_devices.md.
extern const tactus_device_driver driver;

}   // namespace tactus::host::forcedimension
