// SPDX-License-Identifier: MIT
#pragma once

#include <framework/run/guard.hpp>
#include <framework/text/json.hpp>
#include <framework/text/message.hpp>

#include <string>

namespace tactus
{

/// Reads the limits of a guard. A missing key means no limit. docs/safety.md explains each key.
///
///     {"max_force": "3.3 N", "max_torque": …, "max_slew": "500 N/s", "max_torque_slew": …, "ramp": "0.2 s", "watchdog": "20 ms",
///      "max_axis_effort": 2.0, "max_axis_slew": 100, "max_signal": 1.0,
///      "max_speed": "1.5 m/s", "max_impulse": "4 N*s", "impulse_window": "2 s", "max_energy": "50 mJ", "energy_window": "1 s",
///      "dead_man_button": "grip", "dead_man_pressure": "0.5 N"}
///
/// A limit with a window requires the key of the window. A button is given by its name on the device, or by its number from 0.
/// Ids as in ObjectReader.
GuardLimits readGuardLimits (const Json&, std::string where, Messages&, const DeviceLayout& = {});

}   // namespace tactus
