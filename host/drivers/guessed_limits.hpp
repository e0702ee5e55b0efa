// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/json.hpp>

namespace tactus::host
{

/// The hard limits of an arm that has not been measured. All but the largest force, in N, and the impulse in 10 s, in N s, are guesses in the manner of
/// docs/safety.md, "The limits of presets and profiles". The readings have neither a number nor a time that would show a frozen sensor.
inline Json guessedLimits (double max_force, double max_impulse)
{
    Json limits { { "max_force", max_force }, { "max_slew", 250.0 * max_force }, { "max_energy", 0.02 * max_force }, { "max_impulse", max_impulse } };
    limits["energy_window"] = 1.0;
    limits["impulse_window"] = 10.0;
    limits["max_speed"] = 2.0;
    limits["max_still"] = 1.0;
    limits["still_force"] = 0.5;
    limits["watchdog"] = 0.02;
    return limits;
}

/// Adds the limits of a torque, in N m.
inline void addTorque (Json& limits, double max_torque)
{
    limits["max_torque"] = max_torque;
    limits["still_torque"] = 0.02;
    limits["max_torque_slew"] = 50.0;
    limits["max_angular_speed"] = 20.0;
    limits["max_angular_impulse"] = 1.0;
}

}   // namespace tactus::host
