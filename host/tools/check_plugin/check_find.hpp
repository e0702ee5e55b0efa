// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/device_plugins/device_driver.hpp>

#include <string>

namespace tactus::check_plugin
{

/// The fault of a driver's list of devices, which it gives twice; empty if there is none. The driver must have `find`.
std::string faultOfFind (const host::DeviceDriver&);

}   // namespace tactus::check_plugin
