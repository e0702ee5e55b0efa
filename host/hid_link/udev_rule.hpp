// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid_link/transport.hpp>

#include <string>

namespace tactus::host::hid
{

/// The rule that lets whoever sits at the computer open the device.
std::string udevRule (const DeviceInfo&);

/// How to install it, in one sentence with the commands.
std::string howToPermit (const DeviceInfo&);

}   // namespace tactus::host::hid
