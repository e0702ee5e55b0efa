// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/tactus_device.h>

namespace tactus::host::forcedimension
{

/// The driver for the arms of Force Dimension. See docs/known_devices.md. The eager one is for tests: it reads as often as it is asked.
extern const tactus_device_driver driver, eager_driver;

}   // namespace tactus::host::forcedimension
