// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <string>
#include <string_view>

namespace tactus::host
{

/// A route of a session as typed: "mix.out=3@4 N".
std::string textOfRoute (const Json&);

/// Reads a typed route. Keys that cannot be typed (gain, high_pass) are taken from `before`. Id: audio/route.
Result<Json> readRouteText (std::string_view, const Json& before);

/// The channels of a role with the driver "audio": "3@4 N, 4@4 N".
std::string textOfChannels (const Json& list);

/// Reads typed channels. Keys that cannot be typed are taken from the entry of the same channel in `before`. Text that is not a channel
/// number is kept as a string, and rejected when the settings are checked.
Json readChannelsText (std::string_view, const Json& before);

}   // namespace tactus::host
