// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// Lists what the driver of a plugin finds. `driver`: its name, without a port. False if there is no such driver. Ends the command if the driver cannot
/// look. [main thread]
bool listFoundDevices (const std::string& driver, bool as_json);

/// One line that names the drivers in plugins, which are not loaded, and says how to ask them. Empty: there are none. [main thread]
std::string driversText();

}   // namespace tactus::host
