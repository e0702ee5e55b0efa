// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile_reader.hpp>
#include <tactus/text/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// The profiles of devices that are known but that Tactus cannot open.
std::vector<std::shared_ptr<const hid::Profile>> knownByNumbers (const hid::LoadedProfiles&);

/// Id, name and numbers, each number with its source. In SI units.
Json numbersJsonOf (const hid::Profile&);

/// Two lines for the list of devices.
std::string numbersTextOf (const hid::Profile&);

}   // namespace tactus::host
