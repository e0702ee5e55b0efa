// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace tactus::host
{

/// Reads an amount with its unit, such as "10 kPa", "5 mm" or 0.005, as a number above 0 in the SI unit. A bare number is in the SI unit.
/// Throws UsageError, with the name of the option.
double readAmount (const std::string& option, const std::string& text, const char* si_unit, const char* example);

/// The same for a place or a time, which may be 0 or negative.
double readSignedAmount (const std::string& option, const std::string& text, const char* si_unit, const char* example);

}   // namespace tactus::host
