// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/json.hpp>
#include <framework/message.hpp>

#include <string>
#include <string_view>
#include <variant>

namespace tactus::host
{

/// A route of a session as one types it: "mix.out=3@4 N".
std::string textOfRoute (const Json&);

/// The other way. What cannot be typed (gain, high_pass) stays as it was before. Id: audio/route.
std::variant<Json, Message> readRouteText (std::string_view, const Json& before);

/// The channels of a role with the driver "audio": "3@4 N, 4@4 N".
std::string textOfChannels (const Json& list);

/// The other way; what cannot be typed stays as it was with the same channel. What is no channel comes out as it is, for
/// those who check it to complain about.
Json readChannelsText (std::string_view, const Json& before);

}   // namespace tactus::host
