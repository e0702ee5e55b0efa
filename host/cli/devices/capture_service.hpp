// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "capture_device.hpp"

namespace tactus::host
{

/// Records the messages between a driver and its service, such as "haply:localhost:10001", and pushes nothing. False if the device is none of these drivers.
/// Ends the command if it is, but cannot be recorded. [main thread]
bool captureService (const DeviceCapture&);

}   // namespace tactus::host
