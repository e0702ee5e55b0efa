// SPDX-License-Identifier: MIT
#pragma once

#include "event_device.hpp"

#include <tactus/tactus_device.h>

namespace tactus::host::evdev
{

/// The device driver `evdev`: wheels, joysticks and pads with force feedback, through the event devices of Linux. docs/known_devices.md describes its
/// keys: port, calibration, max_rate.
extern const tactus_device_driver driver;

/// The system in which the driver finds its devices. A test sets a fake before it opens any device. [one thread]
void setSystem (EventSystem&);

}   // namespace tactus::host::evdev
