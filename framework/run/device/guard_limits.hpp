// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/guard.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/object_reader.hpp>

#include <string>

namespace tactus
{

/// Reads the limits of a guard. A missing key means no limit. docs/safety.md explains each key.
///
///     {"max_force": "3.3 N", "max_torque": …, "max_slew": "500 N/s", "max_torque_slew": …, "ramp": "0.2 s", "watchdog": "20 ms",
///      "max_axis_effort": 2.0, "max_axis_slew": 100, "max_signal": 1.0, "max_signal_slew": 50,
///      "max_brake": "10 N*s/m", "max_brake_slew": 1000, "brake_at_stop": 0,
///      "max_speed": "1.5 m/s", "max_angular_speed": …, "max_axis_speed": …, "max_energy": "50 mJ", "energy_window": "1 s",
///      "max_impulse": "4 N*s", "max_angular_impulse": …, "max_axis_impulse": …, "impulse_window": "2 s",
///      "max_still": "0.5 s", "still_force": "0.5 N", "still_torque": …,
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

/// The meaning of a slew limit whose effort has no maximum in the same limits.
enum class Unlimited
{
    is_refused,                ///< the limits are complete, and a stop could take forever
    may_be_limited_elsewhere   ///< the limits are those of a session or a graph; the device's profile may have the maximum
};

/// Reports a slew limit that needs longer than longest_stop_s to bring the largest effort to zero: device/slow_stop. [main thread]
void checkStops (const GuardLimits&, const std::string& where, Messages&, Unlimited = Unlimited::is_refused);

}   // namespace tactus
