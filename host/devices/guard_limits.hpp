// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/guard.hpp>
#include <framework/json.hpp>
#include <framework/message.hpp>

#include <string>

namespace tactus::host
{

/// Reads `{"max_force": "3.3 N", "max_torque": …, "max_slew": "500 N/s", "max_torque_slew": …, "ramp": "0.2 s",
/// "watchdog": "20 ms"}`; what is not there limits nothing. Ids as of Fields.
GuardLimits readGuardLimits (const Json&, std::string where, Messages&);

}   // namespace tactus::host
