// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// Shows the readings of a device with a driver in a plugin, such as "haply:localhost:10001", for a time, or until Ctrl-C if it is 0. It gets no force.
/// False if `device` names no such driver. Ends the command if the device cannot be opened. [main thread]
bool probeDriver (const std::string& device, double duration_s, bool as_json);

}   // namespace tactus::host
