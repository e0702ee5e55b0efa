// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/guard.hpp>
#include <tactus/text/json.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

inline constexpr std::string_view run_format = "tactus-run";
/// Version 1 had no axes, signals, device layouts or emergency stops; 2 had no hits; 3 had no faults of readings and no lost time; 5 logged
/// only the time of missing ticks, as `lost`, and its edits did not tighten guards.
inline constexpr int run_version = 6;

/// The fixed properties of a run, stored in the first line of its log.
struct RunHead
{
    std::string program;                              ///< the program and its version
    std::uint64_t functions = 0;                      ///< math::revision of that program; 0: the functions of its C library
    double rate_hz = 0.0;                             ///< tick rate in Hz
    std::vector<std::string> sets {};                 ///< as in --set
    std::vector<std::string> feeds {};                ///< ports, as in CompileOptions::feeds
    std::map<std::string, GuardLimits> guards {};     ///< by role; the guards of roles that join later are logged with their graph
    std::map<std::string, DeviceLayout> devices {};   ///< by role; only devices that have more than a tool
    Json clocks {};                                   ///< when the first tick began: `wall` and `monotonic`, in s; null if it was not in real time
};

/// The limits of a guard, by their names in a log.
struct GuardField
{
    std::string_view key;
    double GuardLimits::*value;
};

inline constexpr GuardField guard_fields[] {
    { "max_force", &GuardLimits::max_force },
    { "max_torque", &GuardLimits::max_torque },
    { "max_slew", &GuardLimits::max_slew },
    { "max_torque_slew", &GuardLimits::max_torque_slew },
    { "ramp", &GuardLimits::ramp },
    { "watchdog", &GuardLimits::watchdog },
    { "max_axis_effort", &GuardLimits::max_axis_effort },
    { "max_axis_slew", &GuardLimits::max_axis_slew },
    { "max_signal", &GuardLimits::max_signal },
    { "max_signal_slew", &GuardLimits::max_signal_slew },
    { "max_brake", &GuardLimits::max_brake },
    { "max_brake_slew", &GuardLimits::max_brake_slew },
    { "brake_at_stop", &GuardLimits::brake_at_stop },
    { "max_speed", &GuardLimits::max_speed },
    { "max_angular_speed", &GuardLimits::max_angular_speed },
    { "max_axis_speed", &GuardLimits::max_axis_speed },
    { "max_impulse", &GuardLimits::max_impulse },
    { "max_angular_impulse", &GuardLimits::max_angular_impulse },
    { "max_axis_impulse", &GuardLimits::max_axis_impulse },
    { "impulse_window", &GuardLimits::impulse_window },
    { "max_energy", &GuardLimits::max_energy },
    { "energy_window", &GuardLimits::energy_window },
    { "max_still", &GuardLimits::max_still },
    { "still_force", &GuardLimits::still_force },
    { "still_torque", &GuardLimits::still_torque },
    { "workspace_scale", &GuardLimits::workspace_scale },
    { "dead_man_pressure", &GuardLimits::dead_man_pressure },
};
inline constexpr std::string_view dead_man_buttons = "dead_man_buttons";   ///< the only limit that is not a double
static_assert (sizeof (GuardLimits) == std::size (guard_fields) * sizeof (double) + sizeof (std::uint64_t),
               "a new limit of a guard must be added to the log too");

}   // namespace tactus
