// SPDX-License-Identifier: MIT
#include "vest_messages.hpp"
#include "vest_map.hpp"

#include <host/drivers/websocket/member.hpp>
#include <tactus/text/json_text.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

Result<VestSettings> VestSettings::read (const Json& description)
{
    constexpr double lowest = 10.0, highest = 1000.0;   // Hz; a message lasts for 100 ms
    auto dots = Dots::read (readJson (vest_map).root, description);
    if (! dots) return std::move (dots).error();
    VestSettings settings { std::move (*dots) };
    const auto* rate = member (description, "rate");
    if (rate == nullptr) return settings;
    if (! rate->is_number() || ! (rate->get<double>() >= lowest && rate->get<double>() <= highest))
        return Message::error ("dots/wrong", {}, "\"rate\" is the most messages per second, 10 to 1000");
    settings.rate_hz = rate->get<double>();
    return settings;
}

std::optional<bool> hasVest (std::string_view message)
{
    const auto read = readJson (message);
    if (! read.messages.empty()) return std::nullopt;
    const auto* all = member (read.root, "ConnectedPositions");
    if (all == nullptr || ! all->is_array()) return true;
    return std::ranges::any_of (*all, [] (const Json& position) { return position.is_string() && position.asString().starts_with ("Vest"); });
}

}   // namespace tactus::host
