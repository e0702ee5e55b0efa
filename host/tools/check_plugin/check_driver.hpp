// SPDX-License-Identifier: MIT
#pragma once

#include "check_plugin.hpp"

#include <vector>

namespace tactus::check_plugin
{

/// Examines a device driver (tactus_device.h), each time in a process of its own. Without a description in the options, no device is opened; with
/// one, its efforts stay zero. [main thread, no other threads]
std::vector<Finding> checkDriver (const Options&);

}   // namespace tactus::check_plugin
