// SPDX-License-Identifier: MIT
#include "profile_fields.hpp"
#include <host/devices/hid/hex.hpp>

#include <tactus/graph/endpoint_text.hpp>
#include <tactus/text/quote.hpp>
#include <tactus/text/units.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace tactus::host::hid
{
namespace
{
constexpr std::size_t most_entries = 256;   // entries per list of objects; a file with more is broken

/// Parses "0x0ce6" or 3302.
std::optional<int> idOf (const Json& json, int max)
{
    double value = -1.0;
    if (json.is_number())
        value = json.get<double>();
    else if (json.is_string())
    {
        const auto text = json.get<std::string>();
        int read = -1;
        const char* const end = text.data() + text.size();
        if (! text.starts_with ("0x") || std::from_chars (text.data() + 2, end, read, 16).ptr != end) return {};
        value = read;
    }
    if (! (value >= 0.0 && value <= max) || value != std::floor (value)) return {};
    return static_cast<int> (value);
}

std::string unitOf (const Measure& measure)
{
    if (measure.angular) return measure.dimension == Dimension { 0, 0, -1 } ? "rad/s" : "rad";
    return measure.dimension == unit::torque.dimension ? "N*m" : symbolOf (measure.dimension);   // not J: devices apply torques
}

std::string idRemedy (int max) { return "write a number from 0 to " + std::to_string (max) + ", or a string such as \"0x1f\""; }
}   // namespace

std::optional<int> ProfileFields::id (std::string_view key, int max)
{
    const Json& json = object (key);
    if (! has (key)) return {};
    const auto value = idOf (json, max);
    if (! value) error (key, "profile/kind", std::string (key) + " is not a number in range", idRemedy (max));
    return value;
}

std::vector<std::uint16_t> ProfileFields::ids (std::string_view key)
{
    std::vector<std::uint16_t> values;
    const Json& json = object (key);
    if (! has (key)) return values;

    const auto take = [&] (const Json& entry) {
        const auto value = idOf (entry, 0xffff);
        if (value)
            values.push_back (static_cast<std::uint16_t> (*value));
        else
            error (key, "profile/kind", std::string (key) + " is not a number in range", idRemedy (0xffff));
    };
    if (json.is_array())
        for (const auto& entry : json)
            take (entry);
    else
        take (json);
    return values;
}

Bytes ProfileFields::hex (std::string_view key)
{
    const auto written = text (key);
    const auto bytes = bytesOf (written);
    if (! bytes)
        error (key, "profile/hex", quote (written) + " is not a list of bytes, or is too long", "write two hexadecimal digits per byte, as in \"02 ff 00*4\"");
    return bytes.value_or (Bytes {});
}

std::string ProfileFields::name (std::string_view key)
{
    if (! has (key))
    {
        require (key, "write \"" + std::string (key) + "\": \"…\"");
        return {};
    }
    auto read = text (key);
    if (graph::isId (read)) return read;
    if (! read.empty()) error (key, "profile/name", quote (read) + " is not a name", "write lower case letters, digits and _, a letter first");
    return {};
}

std::array<std::string, 3> ProfileFields::threeNames (std::string_view key)
{
    std::array<std::string, 3> names;
    const Json* entries = list (key, "three names");
    if (entries == nullptr) return names;

    bool good = entries->size() == 3;
    for (std::size_t i = 0; i < 3 && good; ++i)
        if ((*entries)[i].is_string())
            names[i] = (*entries)[i].get<std::string>();
        else
            good = (*entries)[i].is_null();
    if (! good) error (key, "profile/kind", std::string (key) + " must be a list of three names", "write [\"x\", \"y\", null], with null for a missing one");
    return names;
}

ProfileFields::Scale ProfileFields::scale (std::string_view key, double otherwise)
{
    const Json& json = object (key);
    if (! has (key)) return { otherwise, {} };

    Scale scale;
    if (json.is_number())
        scale.value = json.get<double>();
    else if (json.is_string())
    {
        const auto read = parseMeasure (json.get<std::string>());
        if (! read)
        {
            error (key, "profile/unit", read.error().text, "write a number, or a string such as \"0.1 mm\"");
            return { otherwise, {} };
        }
        scale = { read->value, unitOf (*read) };
    }
    else
    {
        error (key, "profile/kind", std::string (key) + " must be a number", "write a number, or a string such as \"0.1 mm\"");
        return { otherwise, {} };
    }
    if (isFinite (scale.value)) return scale;
    error (key, "profile/out_of_range", std::string (key) + " is not finite", "write a finite number");
    return { otherwise, {} };
}

void ProfileFields::each (std::string_view key, const std::function<void (ProfileFields&)>& read)
{
    const Json* entries = list (key, "objects");
    if (entries == nullptr) return;
    if (entries->size() > most_entries)
        error (key, "profile/too_many", "there are " + std::to_string (entries->size()) + " entries", "write at most " + std::to_string (most_entries));
    for (std::size_t i = 0; i < std::min (entries->size(), most_entries); ++i)
    {
        ProfileFields entry ((*entries)[i], pointer (key) + "/" + std::to_string (i), messages());
        read (entry);
        entry.finish();
    }
}

void ProfileFields::within (std::string_view key, const std::function<void (ProfileFields&)>& read)
{
    const Json& json = object (key);
    if (! has (key)) return;
    ProfileFields inner (json, pointer (key), messages());
    read (inner);
    inner.finish();
}

}   // namespace tactus::host::hid
