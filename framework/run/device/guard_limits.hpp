// SPDX-License-Identifier: MIT
#pragma once

#include <framework/run/guard.hpp>
#include <framework/text/json.hpp>
#include <framework/text/message.hpp>
#include <framework/text/object_reader.hpp>

#include <string>

namespace tactus
{

/// Reads the limits of a guard. A missing key means no limit. docs/safety.md explains each key.
///
///     {"max_force": "3.3 N", "max_torque": …, "max_slew": "500 N/s", "max_torque_slew": …, "ramp": "0.2 s", "watchdog": "20 ms",
///      "max_axis_effort": 2.0, "max_axis_slew": 100, "max_signal": 1.0, "max_signal_slew": 50,
///      "max_speed": "1.5 m/s", "max_angular_speed": …, "max_axis_speed": …, "max_energy": "50 mJ", "energy_window": "1 s",
///      "max_impulse": "4 N*s", "max_angular_impulse": …, "max_axis_impulse": …, "impulse_window": "2 s",
///      "max_still": "0.5 s", "still_force": "0.5 N",
///      "dead_man_button": "grip", "dead_man_pressure": "0.5 N"}
///
/// A limit with a window requires the key of the window, and max_still requires still_force. A button is given by its name on the
/// device, or by its number from 0. Ids: those of ObjectReader, device/unknown_button, device/slow_stop.
GuardLimits readGuardLimits (const Json&, std::string where, Messages&, const DeviceLayout& = {});

/// Reads the limits of efforts and motion from an object that may have other keys: all keys of readGuardLimits except
/// ramp, watchdog and the dead-man's switch.
void readEffortLimits (ObjectReader&, GuardLimits&);

/// The longest time that a stop may take because of slew limits, in s.
inline constexpr double longest_stop_s = 0.5;

/// Reports each slew limit that needs longer than longest_stop_s to bring the largest allowed effort to zero. Ids:
/// device/slow_stop.
void checkStops (const GuardLimits&, const std::string& where, Messages&);

}   // namespace tactus
