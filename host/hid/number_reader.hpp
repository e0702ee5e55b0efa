// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile_fields.hpp>

#include <string>

/// What the fields of input and output reports have in common: where a number stands, and what one count of it is.
namespace tactus::host::hid
{

Bits readBits (ProfileFields&);

/// The scale and, into `unit`, its unit; "1" where neither says one.
double readScale (ProfileFields&, std::string& unit);
double readOffset (ProfileFields&, const std::string& unit);

/// A report says whether it was seen, and if not, why it is believed.
void readVerified (ProfileFields&, bool& verified, std::string& why_not);

inline constexpr int most_bytes = static_cast<int> (longest_report);

}   // namespace tactus::host::hid
