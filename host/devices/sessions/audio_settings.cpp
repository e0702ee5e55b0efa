// SPDX-License-Identifier: MIT
#include "audio_settings.hpp"

#include <tactus/node/device.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/object_reader.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace tactus::host::audio
{
namespace
{
constexpr double most_gain = 1000.0, most_high_pass_hz = 20'000.0, most_rate_hz = 768'000.0;
constexpr double least_reserve_s = 0.001, most_reserve_s = 0.5;
constexpr int most_block = 8192;
constexpr Unit acceleration { Quantity::any, { 1, 0, -2 }, "m/s2" };
constexpr const char* how_full_scale = "write a force, an acceleration or a number above 0, as in \"4 N\", \"20 m/s2\" or 1";

bool isKnown (Dimension d) { return d == unit::newton.dimension || d == acceleration.dimension || d == Dimension {}; }

/// Reads a calibration such as "4 N".
std::optional<FullScale> parseFullScale (std::string_view text)
{
    const auto measure = parseMeasure (text);
    if (! measure || measure->angular || ! isKnown (measure->dimension) || ! std::isfinite (measure->value) || measure->value <= 0.0)
        return std::nullopt;
    const bool has_unit = measure->dimension != Dimension {};
    return FullScale { measure->value, has_unit ? std::optional (measure->dimension) : std::nullopt };
}

FullScale readFullScale (ObjectReader& in)
{
    constexpr const char* key = "full_scale";
    if (! in.has (key)) return {};
    const auto& json = in.object (key);
    if (json.is_number())
        if (const auto value = json.get<double>(); std::isfinite (value) && value > 0.0) return { value, {} };
    if (json.is_string())
        if (const auto read = parseFullScale (json.asString())) return *read;
    in.error (key, "audio/full_scale", json.dump() + " is not a calibration", how_full_scale);
    return {};
}

ChannelUse readChannel (ObjectReader& in, bool is_played)
{
    in.require ("channel", "write \"channel\": a channel of the card, counted from 1");
    ChannelUse use;
    use.channel = in.whole ("channel", 1, most_channels, use.channel);
    use.full_scale = readFullScale (in);
    use.gain = in.number ("gain", unit::gain, { .min = -most_gain, .max = most_gain }, use.gain);
    if (is_played) use.high_pass_hz = in.number ("high_pass", unit::hertz, { .min = 0.0, .max = most_high_pass_hz }, use.high_pass_hz);
    return use;
}

const Json::Array& listOf (ObjectReader& in, const char* key)
{
    static const Json::Array none;
    if (! in.has (key)) return none;
    const auto& json = in.object (key);
    if (json.is_array()) return json.asArray();
    in.error (key, "device/kind", "expected a list", "write [ … ]");
    return none;
}

/// Unknown keys are only warnings: another program may know them.
void warnOfUnknownKeys (Messages& messages, std::size_t from)
{
    for (auto i = from; i < messages.size(); ++i)
        if (messages[i].id == "device/unknown_key") messages[i].severity = Message::Severity::warning;
}

std::vector<ChannelUse> readChannels (ObjectReader& in, const char* key, bool are_played, Messages& messages)
{
    std::vector<ChannelUse> uses;
    const auto& list = listOf (in, key);
    for (std::size_t i = 0; i < list.size(); ++i)
    {
        ObjectReader one (list[i], "/" + std::string (key) + "/" + std::to_string (i), messages);
        uses.push_back (readChannel (one, are_played));
        one.finish();
    }
    if (uses.size() > static_cast<std::size_t> (Channels::most))
    {
        in.error (key, "device/out_of_range", "there are " + std::to_string (uses.size()) + " channels",
                  "use at most " + std::to_string (Channels::most));
        uses.resize (static_cast<std::size_t> (Channels::most));
    }
    return uses;
}

bool isSame (std::string_view a, std::string_view b)
{
    return std::ranges::equal (a, b,
                               [] (char x, char y) { return std::tolower (static_cast<unsigned char> (x)) == std::tolower (static_cast<unsigned char> (y)); });
}
}   // namespace

AudioSettings readAudioSettings (const Json& json, const std::string& where, Messages& messages)
{
    const auto first = messages.size();
    AudioSettings settings;
    ObjectReader in (json, where, messages);
    settings.card.type = in.text ("type");
    settings.card.output = in.text ("output");
    settings.card.input = in.text ("input");
    settings.card.rate_hz = in.number ("rate_hz", unit::hertz, { .min = 1000.0, .max = most_rate_hz }, 0.0);
    settings.card.block = in.whole ("block", 1, most_block, 0);
    settings.reserve_s = in.number ("reserve", unit::second, { .min = least_reserve_s, .max = most_reserve_s }, settings.reserve_s);
    const auto& routes = listOf (in, "routes");
    for (std::size_t i = 0; i < routes.size(); ++i)
    {
        Route route;
        route.where = where + "/routes/" + std::to_string (i);
        route.if_there = true;
        ObjectReader one (routes[i], route.where, messages);
        one.require ("port", "name the port to play, as in \"mix.out\" or \"drag.force.x\"");
        route.port = one.text ("port");
        static_cast<ChannelUse&> (route) = readChannel (one, true);
        one.finish();
        if (! route.port.empty()) settings.routes.push_back (std::move (route));
    }
    in.finish();
    warnOfUnknownKeys (messages, first);
    return settings;
}

AudioSettings readAudioSettings (const LoadedSession& from, Messages& messages)
{
    const auto* written = from.session.audio();
    if (written == nullptr) return {};
    Messages found;
    auto settings = readAudioSettings (*written, "/audio", found);
    for (auto& m : found)
    {
        place (m, from);
        messages.push_back (std::move (m));
    }
    return settings;
}

bool isAudio (const Json& description)
{
    if (! description.is_object()) return false;
    const auto driver = description.find ("driver");
    return driver != description.end() && *driver == "audio";
}

AudioRole readAudioRole (const Json& description, Messages& messages)
{
    AudioRole role;
    ObjectReader in (description, "", messages);
    for (const auto* key : { "driver", "about", "ui", "guard" })
        in.ignore (key);
    in.text ("card");
    role.outputs = readChannels (in, "outputs", true, messages);
    role.inputs = readChannels (in, "inputs", false, messages);
    in.finish();
    return role;
}

Result<Route> parseRoute (std::string_view text)
{
    const auto wrong = [&] (std::string what) {
        return Message::error ("audio/route", "--route " + std::string (text), std::move (what),
                               "write PORT=CHANNEL or PORT=CHANNEL@FULLSCALE, as in mix.out=3@\"4 N\"; channels count from 1");
    };

    const auto equals = text.rfind ('=');
    if (equals == text.npos || equals == 0) return wrong ("PORT= is missing");
    Route route;
    route.port = text.substr (0, equals);
    route.where = "--route " + std::string (text);
    auto channel = text.substr (equals + 1);
    if (const auto at = channel.find ('@'); at != channel.npos)
    {
        const auto full_scale = parseFullScale (channel.substr (at + 1));
        if (! full_scale) return wrong (quote (channel.substr (at + 1)) + " is not a calibration: " + how_full_scale);
        route.full_scale = *full_scale;
        channel = channel.substr (0, at);
    }
    const auto [end, error] = std::from_chars (channel.data(), channel.data() + channel.size(), route.channel);
    if (error != std::errc {} || end != channel.data() + channel.size() || route.channel < 1 || route.channel > most_channels)
        return wrong (quote (channel) + " is not a channel from 1 to " + std::to_string (most_channels));
    return route;
}

CardRequest parseCard (std::string_view text, const std::vector<std::string>& types)
{
    CardRequest wanted;
    const auto typeNamed = [&] (std::string_view name) {
        const auto it = std::ranges::find_if (types, [&] (const std::string& t) { return isSame (t, name); });
        return it == types.end() ? std::string() : *it;
    };
    const auto colon = text.find (':');
    if (auto type = typeNamed (text.substr (0, colon)); ! type.empty())
    {
        wanted.type = std::move (type);
        text = colon == text.npos ? std::string_view() : text.substr (colon + 1);
    }
    wanted.output = text;
    return wanted;
}

std::string unitProblem (const FullScale& full_scale, std::string_view unit)
{
    if (unit.empty() || ! full_scale.dimension) return {};
    const auto measure = parseMeasure ("1 " + std::string (unit));
    if (! measure || measure->dimension == *full_scale.dimension) return {};
    return "its unit is " + std::string (unit) + ", but the channel is calibrated in " + symbolOf (*full_scale.dimension);
}

}   // namespace tactus::host::audio
