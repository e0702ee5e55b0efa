// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/devices/fields.hpp>
#include <host/devices/problem.hpp>

#include <framework/in_quotes.hpp>
#include <framework/near_miss.hpp>
#include <framework/units.hpp>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace tactus::host
{
namespace
{
const Json nothing = Json::object();

/// A key as it stands in a JSON pointer.
std::string escaped (std::string_view key)
{
    std::string out;
    for (const char c : key)
    {
        if (c == '~')
            out += "~0";
        else if (c == '/')
            out += "~1";
        else
            out += c;
    }
    return out;
}

std::string kindOf (const Json& value)
{
    if (value.is_string()) return "a text";
    if (value.is_array()) return "a list of " + std::to_string (value.size());
    if (value.is_object()) return "an object";
    if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
    if (value.is_null()) return "null";
    return "a number";
}

std::string joined (std::span<const std::string> names)
{
    std::string out;
    for (const auto& name : names)
        out += (out.empty() ? "" : ", ") + name;
    return out;
}

std::string example (const Unit& unit)
{
    const std::string symbol (unit.symbol);
    return symbol == "1" ? "a number" : "a number in " + symbol + ", or a text such as \"1 " + symbol + "\"";
}
}   // namespace

std::string suggestion (std::string_view name, std::span<const std::string> names)
{
    const std::vector<std::string_view> views (names.begin(), names.end());
    const auto meant = nearMiss (name, views);
    return meant.empty() ? "there are: " + joined (names) : "did you mean " + inQuotes (meant) + "?";
}

Fields::Fields (const Json& what, std::string where, Messages& list)
    : fields (what.is_object() ? what : nothing), here (std::move (where)), messages (list)
{
    if (! what.is_object())
        messages.push_back (problem ("device/kind", here, "expected an object, found " + kindOf (what), "write { … }"));
}

bool Fields::has (std::string_view key) const { return fields.contains (key); }

const Json* Fields::find (std::string_view key)
{
    known.emplace_back (key);
    const auto it = fields.find (key);
    return it == fields.end() ? nullptr : &*it;
}

void Fields::error (std::string_view key, std::string id, std::string text, std::string remedy)
{
    messages.push_back (problem (std::move (id), here + "/" + escaped (key), std::move (text), std::move (remedy)));
}

bool Fields::measure (const Json& json, const std::string& pointer, const Unit& unit, double& value)
{
    const auto wrong = [&] (const char* id, std::string text)
    {
        messages.push_back (problem (id, pointer, std::move (text), "write " + example (unit)));
        return false;
    };

    if (json.is_number())
        value = json.get<double>();
    else if (json.is_string())
    {
        const auto text = json.get<std::string>();
        const auto read = parseMeasure (text);
        if (const auto* sentence = std::get_if<std::string> (&read)) return wrong ("device/unit", *sentence);

        const auto& measure = std::get<Measure> (read);
        if (measure.dimension != unit.dimension)
            return wrong ("device/unit", inQuotes (text) + " is in " + symbolOf (measure.dimension) + ", but this is in " + std::string (unit.symbol));
        value = measure.value;
    }
    else
        return wrong ("device/kind", "expected a number, found " + kindOf (json));

    if (! isFinite (value)) return wrong ("device/out_of_range", "the number is not finite");
    return true;
}

double Fields::number (std::string_view key, const Unit& unit, Bounds bounds, double otherwise)
{
    const Json* json = find (key);
    double value = 0.0;
    if (json == nullptr || ! measure (*json, here + "/" + escaped (key), unit, value)) return otherwise;

    const bool too_small = bounds.without_min ? value <= bounds.min : value < bounds.min;
    if (! too_small && value <= bounds.max) return value;

    const auto limit = too_small ? std::string (bounds.without_min ? "more than " : "at least ") + numberText (bounds.min) : "at most " + numberText (bounds.max);
    error (key, "device/out_of_range", std::string (key) + " is " + numberText (value) + " " + std::string (unit.symbol) + ", which is out of range", "it has to be " + limit + " " + std::string (unit.symbol));
    return otherwise;
}

int Fields::whole (std::string_view key, int min, int max, int otherwise)
{
    const Json* json = find (key);
    if (json == nullptr) return otherwise;

    const auto remedy = "write a whole number from " + std::to_string (min) + " to " + std::to_string (max);
    if (! json->is_number())
        error (key, "device/kind", "expected a whole number, found " + kindOf (*json), remedy);
    else if (const auto value = json->get<double>(); value != std::floor (value))
        error (key, "device/kind", std::string (key) + " is " + numberText (value) + ", which is not a whole number", remedy);
    else if (value < min || value > max)
        error (key, "device/out_of_range", std::string (key) + " is " + numberText (value) + ", which is out of range", remedy);
    else
        return static_cast<int> (value);
    return otherwise;
}

Vec3 Fields::vector (std::string_view key, const Unit& unit, const Vec3& otherwise)
{
    const Json* json = find (key);
    if (json == nullptr) return otherwise;

    if (! json->is_array() || json->size() != 3)
    {
        error (key, "device/kind", "expected a vector, found " + kindOf (*json), "write [x, y, z], each " + example (unit));
        return otherwise;
    }

    Vec3 value;
    bool good = true;
    for (int i = 0; i < 3; ++i)
        good = measure ((*json)[static_cast<std::size_t> (i)], here + "/" + escaped (key) + "/" + std::to_string (i), unit, value[i]) && good;
    return good ? value : otherwise;
}

std::string Fields::text (std::string_view key)
{
    const Json* json = find (key);
    if (json == nullptr) return {};
    if (json->is_string() && ! json->get_ref<const std::string&>().empty()) return json->get<std::string>();

    error (key, "device/kind", "expected a text, found " + (json->is_string() ? "an empty one" : kindOf (*json)), "write a text in quotes");
    return {};
}

const Json& Fields::object (std::string_view key)
{
    const Json* json = find (key);
    return json == nullptr ? nothing : *json;
}

void Fields::require (std::string_view key, std::string_view remedy)
{
    if (! has (key)) messages.push_back (problem ("device/missing", here, inQuotes (key) + " is missing", std::string (remedy)));
}

void Fields::ignore (std::string_view key) { known.emplace_back (key); }

void Fields::finish()
{
    for (const auto& [key, value] : fields.items())
        if (std::ranges::find (known, key) == known.end())
            error (key, "device/unknown_key", inQuotes (key) + " means nothing here", suggestion (key, known));
}

}   // namespace tactus::host
