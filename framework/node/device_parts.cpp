// SPDX-License-Identifier: MIT
#include "device_parts.hpp"
#include <tactus/text/closest_match.hpp>
#include <tactus/text/quote.hpp>

namespace tactus
{

std::string lacking (std::string_view kind, std::string_view plural, std::string_view name, const std::vector<std::string>& there)
{
    if (partNamed (name, there) >= 0) return {};
    std::vector<std::string> named = there;
    std::erase (named, "");
    auto text = "no " + std::string (kind) + " " + quote (name) + didYouMean (name, named);
    if (there.empty()) return text + "; it has no " + std::string (plural) + " at all";
    if (named.empty()) return text + "; its " + std::to_string (there.size()) + " " + std::string (plural) + " have no names";

    text += "; its " + std::string (plural) + ": ";
    for (const auto& n : named)
        text += (&n == named.data() ? "" : ", ") + quote (n);
    return text;
}

std::string lackingChannel (std::string_view kind, int channel, int there)
{
    if (channel <= there) return {};
    return "no " + std::string (kind) + " " + std::to_string (channel) + "; it has " + (there == 0 ? "none at all" : std::to_string (there));
}

}   // namespace tactus
