// SPDX-License-Identifier: MIT
#pragma once

#include "profile_fields.hpp"

#include <map>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// Laws that several fields share, by name: the x and y of a table.
using Tables = std::map<std::string, std::pair<std::vector<double>, std::vector<double>>>;

/// Reads the reports of a profile, and adds a message for each problem. [main thread]
Tables readTables (ProfileFields& profile);
std::vector<InputReport> readInputs (ProfileFields& profile);
std::vector<OutputReport> readOutputs (ProfileFields& profile, const Tables&);

}   // namespace tactus::host::hid
