// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/guard.hpp>
#include <framework/json.hpp>
#include <framework/message.hpp>

#include <string>

namespace tactus::host
{

/// Reads what a guard is to allow; what is not there limits nothing. docs/safety.md says what each of it does.
///
///     {"max_force": "3.3 N", "max_torque": …, "max_slew": "500 N/s", "max_torque_slew": …, "ramp": "0.2 s", "watchdog": "20 ms",
///      "max_axis_effort": 2.0, "max_axis_slew": 100, "max_signal": 1.0,
///      "max_speed": "1.5 m/s", "max_impulse": "4 N*s", "impulse_window": "2 s", "max_energy": "50 mJ", "energy_window": "1 s",
///      "dead_man_button": "grip", "dead_man_pressure": "0.5 N"}
///
/// A limit with a window needs it. A button is one of the device's, by name, or by number from 0. Ids as of Fields.
GuardLimits readGuardLimits (const Json&, std::string where, Messages&, const DeviceLayout& = {});

}   // namespace tactus::host
