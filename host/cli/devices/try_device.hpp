// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// Leads a person at the terminal through a trial of a device, and writes the report, even if the trial ends early. `what`: a role of the user's session,
/// or a device as in --device. Ends the command if the device cannot be opened, or if a step differs from what was expected. [main thread]
void tryOnDevice (const std::string& what, const std::string& report);

}   // namespace tactus::host
