// SPDX-License-Identifier: MIT
#pragma once

#include "transport.hpp"

#include <host/devices/hid/pid_device.hpp>

#include <memory>
#include <optional>
#include <string_view>

namespace tactus::host::hid
{

/// The profile id that selects any device with force feedback according to the USB standard (PID). There is no file for it.
inline constexpr std::string_view pid_profile = "pid";

/// True if the report descriptor of this device declares force feedback according to the standard. [main thread]
bool hasForceFeedback (HidSystem&, const ConnectedDevice&);

/// Makes a profile from the device's own report descriptor. calibrationOf completes the calibration. Null if there is an error.
/// Ids: pid/missing, pid/uncalibrated, pid/no_axis, pid/no_travel, descriptor/… [main thread]
std::shared_ptr<const Profile> profileOf (HidSystem&, const ConnectedDevice&, const std::optional<PidCalibration>&, Messages&);

}   // namespace tactus::host::hid
