// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/hid/profile_reader.hpp>
#include <tactus/text/json.hpp>

#include <memory>
#include <string>
#include <vector>

namespace tactus::host
{

/// The profiles of devices that Tactus knows but cannot open.
std::vector<std::shared_ptr<const hid::Profile>> knownByNumbers (const hid::LoadedProfiles&);

/// Id, name and numbers of a profile, in SI units; each number with its source.
Json numbersJsonOf (const hid::Profile&);

/// Two lines about a profile, for the list of devices.
std::string numbersTextOf (const hid::Profile&);

}   // namespace tactus::host
