// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/pid_device.hpp>
#include <host/hid_link/transport.hpp>

#include <framework/json.hpp>

#include <memory>
#include <optional>
#include <string_view>

namespace tactus::host::hid
{

/// The profile that means any device with force feedback by the USB standard (PID), which no file describes.
inline constexpr std::string_view pid_profile = "pid";

/// True if this device says that it has force feedback by the standard. [main thread]
bool hasForceFeedback (HidSystem&, const ConnectedDevice&);

/// What a description says under "calibration": nothing if it says nothing. [main thread]
///
///     "calibration": {"full_force": "4 N", "travel": {"x": "12 cm", "y": "12 cm"}, "reversed": false}
///     "calibration": {"full_force": "2.5 N*m", "travel": {"steering": "900 deg"}}
///
/// Ids: those of Fields.
std::optional<PidCalibration> readCalibration (const Json& description, Messages&);

/// Profile of this device, made from its own descriptor. Without a calibration nobody knows how strong it is: then it is
/// taken for a stick of 10 cm and 10 N that may give a tenth of what it can, and a warning says so.
/// Null with an error. Ids: pid/missing, pid/uncalibrated, pid/no_axis, descriptor/… [main thread]
std::shared_ptr<const Profile> profileOf (HidSystem&, const ConnectedDevice&, const std::optional<PidCalibration>&, Messages&);

}   // namespace tactus::host::hid
