// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// Formats a value with an SI prefix: "3.1 mJ".
std::string withPrefix (double value, const std::string& unit, int digits = 3);

}   // namespace tactus::host
