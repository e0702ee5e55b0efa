// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// "3.1 mJ": so many digits, with an SI prefix.
std::string withPrefix (double value, const std::string& unit, int digits = 3);

}   // namespace tactus::host
