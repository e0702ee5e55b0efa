// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile_fields.hpp>

#include <map>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// Laws that several fields share, by name: x and y.
using Tables = std::map<std::string, std::pair<std::vector<double>, std::vector<double>>>;

/// The reports of a profile; what is wrong within each gets a message. [main thread]
Tables readTables (ProfileFields& profile);
std::vector<InputReport> readInputs (ProfileFields& profile);
std::vector<OutputReport> readOutputs (ProfileFields& profile, const Tables&);

}   // namespace tactus::host::hid
