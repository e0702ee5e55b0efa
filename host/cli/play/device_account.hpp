// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/sessions/device_health.hpp>
#include <host/devices/sessions/run_clock.hpp>

#include <span>
#include <string>

namespace tactus::host
{

/// Text for the status line: the state of the devices, and which clock ticks the run if it is not the chosen one.
std::string statusOf (std::span<const DeviceHealth>, const RunClock*);

/// Text for the end of a run: a few lines for each device about its traffic.
std::string accountOf (std::span<const RealDevice>, std::span<const PluginRole>, std::span<const DeviceHealth>, const RunClock*);

}   // namespace tactus::host
