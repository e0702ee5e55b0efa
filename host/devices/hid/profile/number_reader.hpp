// SPDX-License-Identifier: MIT
#pragma once

#include "profile_fields.hpp"

#include <string>

/// Shared by the fields of input and output reports: the position of a number, and the value of one count.
namespace tactus::host::hid
{

Bits readBits (ProfileFields&);

/// Returns the scale and stores its unit in `unit`; "1" if no unit is given.
double readScale (ProfileFields&, std::string& unit);
double readOffset (ProfileFields&, const std::string& unit);

/// Reads whether a report is verified and, if it is not, why it is not.
void readVerified (ProfileFields&, bool& verified, std::string& why_not);

inline constexpr int most_bytes = static_cast<int> (longest_report);

}   // namespace tactus::host::hid
