// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/guard.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

inline constexpr std::string_view run_format = "tactus-run";
inline constexpr int run_version = 3;   ///< 1 had no axes, signals, layouts of devices and emergency stops, 2 no hits

/// What is fixed when a run begins: the first line of its log.
struct RunHead
{
    std::string program;                              ///< with its version
    double rate_hz = 0.0;                             ///< Hz, of the ticks
    std::vector<std::string> sets {};                 ///< as --set
    std::vector<std::string> feeds {};                ///< ports, as CompileOptions::feeds
    std::map<std::string, GuardLimits> guards {};     ///< by role; those that join later come with their graph
    std::map<std::string, DeviceLayout> devices {};   ///< the same, of those that have more than a tool
};

/// The limits of a guard by the names that a log has for them.
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
    { "max_speed", &GuardLimits::max_speed },
    { "max_impulse", &GuardLimits::max_impulse },
    { "impulse_window", &GuardLimits::impulse_window },
    { "max_energy", &GuardLimits::max_energy },
    { "energy_window", &GuardLimits::energy_window },
    { "dead_man_pressure", &GuardLimits::dead_man_pressure },
};
inline constexpr std::string_view dead_man_buttons = "dead_man_buttons";   ///< the one that is no double
static_assert (sizeof (GuardLimits) == std::size (guard_fields) * sizeof (double) + sizeof (std::uint64_t), "what is new in a guard belongs into the log as well");

}   // namespace tactus::host
