// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/guard.hpp>

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

inline constexpr std::string_view run_format = "tactus-run";
inline constexpr int run_version = 1;

/// What is fixed when a run begins: the first line of its log.
struct RunHead
{
    std::string program;                            ///< with its version
    double rate_hz = 0.0;                           ///< Hz, of the ticks
    std::vector<std::string> sets {};               ///< as --set
    std::vector<std::string> feeds {};              ///< ports, as CompileOptions::feeds
    std::map<std::string, GuardLimits> guards {};   ///< by role; those that join later come with their graph
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
};
static_assert (sizeof (GuardLimits) == std::size (guard_fields) * sizeof (double), "what is new in a guard belongs into the log as well");

}   // namespace tactus::host
