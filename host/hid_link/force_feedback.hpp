// SPDX-License-Identifier: MIT
#pragma once

#include "transport.hpp"

#include <host/hid/pid_device.hpp>
#include <tactus/text/json.hpp>

#include <memory>
#include <optional>
#include <string_view>

namespace tactus::host::hid
{

/// The profile id that selects any device with force feedback according to the USB standard (PID). There is no file for it.
inline constexpr std::string_view pid_profile = "pid";

/// True if the report descriptor of this device declares force feedback according to the standard. [main thread]
bool hasForceFeedback (HidSystem&, const ConnectedDevice&);

/// Reads the key "calibration" of a description. Empty if there is no such key. [main thread]
///
///     "calibration": {"full_force": "4 N", "travel": {"x": "12 cm", "y": "12 cm"}, "reversed": false}
///     "calibration": {"full_force": "2.5 N*m", "travel": {"steering": "900 deg"}}
///
/// Ids: those of ObjectReader.
std::optional<PidCalibration> readCalibration (const Json& description, Messages&);

/// Makes a profile from the device's own report descriptor. Without a calibration the device's strength is unknown: there is
/// a warning, and it is treated as a stick with 10 cm of travel and 10 N of force, of which a tenth may be used. Null if
/// there is an error.
/// Without the travel of the axis that is driven, a usual one is assumed, with a warning.
/// Ids: pid/missing, pid/uncalibrated, pid/no_axis, pid/no_travel, descriptor/… [main thread]
std::shared_ptr<const Profile> profileOf (HidSystem&, const ConnectedDevice&, const std::optional<PidCalibration>&, Messages&);

}   // namespace tactus::host::hid
