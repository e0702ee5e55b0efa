// SPDX-License-Identifier: GPL-3.0-or-later
#include "sound_text.hpp"

#include <tactus/text/list_text.hpp>

#include <host/devices/sessions/audio_settings.hpp>

#include <charconv>

namespace tactus::host
{

namespace
{
std::string_view trim (std::string_view text)
{
    const auto begin = text.find_first_not_of (" \t");
    if (begin == std::string_view::npos) return {};
    return text.substr (begin, text.find_last_not_of (" \t") - begin + 1);
}

std::string plain (const Json& v) { return v.is_string() ? v.get<std::string>() : v.dump(); }

std::string textOfChannel (const Json& use)
{
    if (! use.is_object()) return use.dump();
    const auto full_scale = use.find ("full_scale");
    return plain (use.value ("channel", Json (1))) + (full_scale != use.end() ? "@" + plain (*full_scale) : std::string());
}

/// Reads "3@4 N" into an object, which may have other keys.
void readChannelText (std::string_view text, Json& use)
{
    const auto at = text.find ('@');
    const auto number = trim (text.substr (0, at));
    int channel = 0;
    const auto [end, error] = std::from_chars (number.data(), number.data() + number.size(), channel);
    if (error == std::errc {} && end == number.data() + number.size())
        use["channel"] = channel;
    else
        use["channel"] = std::string (number);
    if (at == std::string_view::npos)
        use.erase ("full_scale");
    else
        use["full_scale"] = std::string (trim (text.substr (at + 1)));
}
}   // namespace

std::string textOfRoute (const Json& route)
{
    return route.is_object() ? plain (route.value ("port", Json (""))) + "=" + textOfChannel (route) : route.dump();
}

Result<Json> readRouteText (std::string_view text, const Json& before)
{
    const auto parsed = audio::parseRoute (text);
    if (! parsed) return parsed.error();
    Json route = before.is_object() ? before : Json::object();
    route["port"] = parsed->port;
    readChannelText (text.substr (text.find ('=') + 1), route);
    return route;
}

std::string textOfChannels (const Json& list)
{
    if (! list.is_array()) return list.dump();
    std::string text;
    for (const auto& use : list)
        addToList (text, textOfChannel (use));
    return text;
}

Json readChannelsText (std::string_view text, const Json& before)
{
    auto list = Json::array();
    while (! trim (text).empty())
    {
        const auto comma = text.find (',');
        Json use = Json::object();
        readChannelText (trim (text.substr (0, comma)), use);
        if (before.is_array())
            for (const auto& old : before)
                if (old.is_object() && old.value ("channel", Json()) == use["channel"])
                    for (const auto& [key, value] : old.items())
                        if (key != "full_scale" && ! use.contains (key)) use[key] = value;
        list.push_back (std::move (use));
        text = comma == std::string_view::npos ? std::string_view() : text.substr (comma + 1);
    }
    return list;
}

}   // namespace tactus::host
