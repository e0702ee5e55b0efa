// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/hid/hex.hpp>
#include <host/hid/profile_fields.hpp>

#include <framework/file/json_text.hpp>
#include <framework/graph/text.hpp>
#include <framework/in_quotes.hpp>
#include <framework/units.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>
#include <variant>

namespace tactus::host::hid
{
namespace
{
constexpr std::size_t most_entries = 256;   // of any list of objects: more is a broken file

/// "0x0ce6" or 3302.
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
    return measure.dimension == unit::torque.dimension ? "N*m" : symbolOf (measure.dimension);   // not J: devices twist
}

std::string idRemedy (int max) { return "write a number from 0 to " + std::to_string (max) + ", or a text such as \"0x1f\""; }
}   // namespace

ProfileFields::ProfileFields (const Json& what, std::string where, Messages& list) : Fields (what, where, list), self (what), place (std::move (where)), all (list) {}

bool ProfileFields::flag (std::string_view key, bool otherwise)
{
    const Json& json = object (key);
    if (! has (key)) return otherwise;
    if (json.is_boolean()) return json.get<bool>();
    error (key, "profile/kind", std::string (key) + " has to be true or false", "write true or false");
    return otherwise;
}

std::optional<int> ProfileFields::id (std::string_view key, int max)
{
    const Json& json = object (key);
    if (! has (key)) return {};
    const auto value = idOf (json, max);
    if (! value) error (key, "profile/kind", std::string (key) + " is not such a number", idRemedy (max));
    return value;
}

std::vector<std::uint16_t> ProfileFields::ids (std::string_view key)
{
    std::vector<std::uint16_t> values;
    const Json& json = object (key);
    if (! has (key)) return values;

    const auto take = [&] (const Json& entry)
    {
        const auto value = idOf (entry, 0xffff);
        if (value)
            values.push_back (static_cast<std::uint16_t> (*value));
        else
            error (key, "profile/kind", std::string (key) + " is not such a number", idRemedy (0xffff));
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
    if (! bytes) error (key, "profile/hex", inQuotes (written) + " are not bytes, or too many", "write two hexadecimal digits a byte, as in \"02 ff 00*4\"");
    return bytes.value_or (Bytes {});
}

const Json* ProfileFields::listOf (std::string_view key, std::string_view what)
{
    const Json& json = object (key);
    if (! has (key)) return nullptr;
    if (json.is_array()) return &json;
    error (key, "profile/kind", std::string (key) + " has to be a list of " + std::string (what), "write [ … ]");
    return nullptr;
}

std::vector<std::string> ProfileFields::texts (std::string_view key)
{
    std::vector<std::string> read;
    const Json* list = listOf (key, "texts");
    if (list == nullptr) return read;
    for (const auto& entry : *list)
        if (entry.is_string())
            read.push_back (entry.get<std::string>());
        else
            error (key, "profile/kind", std::string (key) + " has to be a list of texts", "write [\"…\"]");
    return read;
}

std::vector<double> ProfileFields::numbers (std::string_view key)
{
    std::vector<double> read;
    const Json* list = listOf (key, "numbers");
    if (list == nullptr) return read;
    for (const auto& entry : *list)
        if (entry.is_number() && isFinite (entry.get<double>()))
            read.push_back (entry.get<double>());
        else
            error (key, "profile/kind", std::string (key) + " has to be a list of numbers", "write [1, 2]");
    return read;
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
    if (! read.empty()) error (key, "profile/name", inQuotes (read) + " is not a name", "write lower case letters, digits and _, a letter first");
    return {};
}

std::array<std::string, 3> ProfileFields::threeNames (std::string_view key)
{
    std::array<std::string, 3> names;
    const Json* list = listOf (key, "three names");
    if (list == nullptr) return names;

    bool good = list->size() == 3;
    for (std::size_t i = 0; i < 3 && good; ++i)
        if ((*list)[i].is_string())
            names[i] = (*list)[i].get<std::string>();
        else
            good = (*list)[i].is_null();
    if (! good) error (key, "profile/kind", std::string (key) + " has to be a list of three names", "write [\"x\", \"y\", null], null for what there is not");
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
        if (const auto* sentence = std::get_if<std::string> (&read))
        {
            error (key, "profile/unit", *sentence, "write a number, or a text such as \"0.1 mm\"");
            return { otherwise, {} };
        }
        scale = { std::get<Measure> (read).value, unitOf (std::get<Measure> (read)) };
    }
    else
    {
        error (key, "profile/kind", std::string (key) + " has to be a number", "write a number, or a text such as \"0.1 mm\"");
        return { otherwise, {} };
    }
    if (isFinite (scale.value)) return scale;
    error (key, "profile/out_of_range", std::string (key) + " is not finite", "write a finite number");
    return { otherwise, {} };
}

void ProfileFields::each (std::string_view key, const std::function<void (ProfileFields&)>& read)
{
    const Json* list = listOf (key, "objects");
    if (list == nullptr) return;
    if (list->size() > most_entries) error (key, "profile/too_many", "there are " + std::to_string (list->size()) + " entries", "write " + std::to_string (most_entries) + " at most");
    for (std::size_t i = 0; i < std::min (list->size(), most_entries); ++i)
    {
        ProfileFields entry ((*list)[i], place + "/" + pointerPart (key) + "/" + std::to_string (i), all);
        read (entry);
        entry.finish();
    }
}

void ProfileFields::within (std::string_view key, const std::function<void (ProfileFields&)>& read)
{
    const Json& json = object (key);
    if (! has (key)) return;
    ProfileFields inner (json, place + "/" + pointerPart (key), all);
    read (inner);
    inner.finish();
}

}   // namespace tactus::host::hid
