// SPDX-License-Identifier: MIT
#pragma once

#include "transport.hpp"

#include <string>

namespace tactus::host::hid
{

/// The udev rule that allows the user who is logged in at the computer to open the device.
std::string udevRule (const DeviceInfo&);

/// Instructions for installing the rule, with the commands.
std::string howToPermit (const ConnectedDevice&);

}   // namespace tactus::host::hid
