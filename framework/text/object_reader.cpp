// SPDX-License-Identifier: MIT
#include "object_reader.hpp"

#include "closest_match.hpp"
#include "json_text.hpp"
#include "number_text.hpp"
#include "quote.hpp"
#include "units.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus
{
namespace
{
const Json empty_object = Json::object();

std::string kindOf (const Json& value)
{
    if (value.is_string()) return "a string";
    if (value.is_array()) return "a list of " + std::to_string (value.size());
    if (value.is_object()) return "an object";
    if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
    if (value.is_null()) return "null";
    return "a number";
}

std::string example (const Unit& unit)
{
    const std::string symbol (unit.symbol);
    return symbol == "1" ? "a number" : "a number in " + symbol + ", or a string such as \"1 " + symbol + "\"";
}
}   // namespace

ObjectReader::ObjectReader (const Json& object, std::string where, Messages& list, std::string_view id_prefix)
    : given (object), object_here (object.is_object() ? object : empty_object), here (std::move (where)), all_messages (list), prefix (id_prefix)
{
    if (! object.is_object())
        add (Message::error (messageId ("kind"), here, "expected an object, found " + kindOf (object), "write { … }"));
}

std::string ObjectReader::pointer (std::string_view key) const { return here + "/" + pointerPart (key); }

const Json* ObjectReader::find (std::string_view key)
{
    known.emplace_back (key);
    const auto member = object_here.find (key);
    return member == object_here.end() ? nullptr : &*member;
}

void ObjectReader::add (Message message)
{
    if (is_full) return;
    is_full = all_messages.size() >= most_messages;
    if (is_full)
        message = Message::error (messageId ("more"), here, "there are more problems than the " + std::to_string (most_messages) + " that are listed",
                                  "fix these first");
    all_messages.push_back (std::move (message));
}

void ObjectReader::error (std::string_view key, std::string id, std::string text, std::string remedy)
{
    add (Message::error (std::move (id), pointer (key), std::move (text), std::move (remedy)));
}

bool ObjectReader::measure (const Json& json, const std::string& where, const Unit& unit, double& value)
{
    const auto wrong = [&] (const char* what, std::string text) {
        add (Message::error (messageId (what), where, std::move (text), "write " + example (unit)));
        return false;
    };

    if (json.is_number())
        value = json.get<double>();
    else if (json.is_string())
    {
        const auto text = json.get<std::string>();
        const auto read = parseMeasure (text);
        if (! read) return wrong ("unit", read.error().text);
        if (read->dimension != unit.dimension)
            return wrong ("unit", quote (text) + " is in " + symbolOf (read->dimension) + ", but this value must be in " + std::string (unit.symbol));
        value = read->value;
    }
    else
        return wrong ("kind", "expected a number, found " + kindOf (json));

    if (! std::isfinite (value)) return wrong ("out_of_range", "the number is not finite");
    return true;
}

double ObjectReader::number (std::string_view key, const Unit& unit, Bounds bounds, double otherwise)
{
    const Json* json = find (key);
    double value = 0.0;
    if (json == nullptr || ! measure (*json, pointer (key), unit, value)) return otherwise;

    const bool too_small = bounds.without_min ? value <= bounds.min : value < bounds.min;
    if (! too_small && value <= bounds.max) return value;

    const std::string symbol (unit.symbol);
    const auto least = std::string (bounds.without_min ? "more than " : "at least ") + numberText (bounds.min);
    error (key, messageId ("out_of_range"), std::string (key) + " is " + numberText (value) + " " + symbol + ", which is out of range",
           "it must be " + (too_small ? least : "at most " + numberText (bounds.max)) + " " + symbol);
    return otherwise;
}

int ObjectReader::whole (std::string_view key, int min, int max, int otherwise)
{
    const Json* json = find (key);
    if (json == nullptr) return otherwise;

    const auto remedy = "write a whole number from " + std::to_string (min) + " to " + std::to_string (max);
    if (! json->is_number())
        error (key, messageId ("kind"), "expected a whole number, found " + kindOf (*json), remedy);
    else if (const auto value = json->get<double>(); value != std::floor (value))
        error (key, messageId ("kind"), std::string (key) + " is " + numberText (value) + ", which is not a whole number", remedy);
    else if (value < min || value > max)
        error (key, messageId ("out_of_range"), std::string (key) + " is " + numberText (value) + ", which is out of range", remedy);
    else
        return static_cast<int> (value);
    return otherwise;
}

bool ObjectReader::readVector (std::string_view key, const Unit& unit, std::array<double, 3>& value)
{
    const Json* json = find (key);
    if (json == nullptr) return false;
    if (! json->is_array() || json->size() != value.size())
    {
        error (key, messageId ("kind"), "expected a vector, found " + kindOf (*json), "write [x, y, z], each " + example (unit));
        return false;
    }

    bool good = true;
    for (std::size_t i = 0; i < value.size(); ++i)
        good = measure ((*json)[i], pointer (key) + "/" + std::to_string (i), unit, value[i]) && good;
    return good;
}

std::string ObjectReader::text (std::string_view key)
{
    const Json* json = find (key);
    if (json == nullptr) return {};
    if (json->is_string() && ! json->asString().empty()) return json->get<std::string>();

    error (key, messageId ("kind"), "expected a nonempty string, found " + (json->is_string() ? "an empty one" : kindOf (*json)), "write a string in quotes");
    return {};
}

const Json& ObjectReader::object (std::string_view key)
{
    const Json* json = find (key);
    return json == nullptr ? empty_object : *json;
}

bool ObjectReader::flag (std::string_view key, bool otherwise)
{
    const Json* json = find (key);
    if (json == nullptr) return otherwise;
    if (json->is_boolean()) return json->get<bool>();
    error (key, messageId ("kind"), std::string (key) + " must be true or false", "write true or false");
    return otherwise;
}

const Json* ObjectReader::list (std::string_view key, std::string_view what)
{
    const Json* json = find (key);
    if (json == nullptr || json->is_array()) return json;
    error (key, messageId ("kind"), std::string (key) + " must be a list of " + std::string (what), "write [ … ]");
    return nullptr;
}

std::vector<std::string> ObjectReader::texts (std::string_view key)
{
    std::vector<std::string> read;
    const Json* entries = list (key, "strings");
    if (entries == nullptr) return read;
    for (const auto& entry : *entries)
        if (entry.is_string())
            read.push_back (entry.get<std::string>());
        else
            error (key, messageId ("kind"), std::string (key) + " must be a list of strings", "write [\"…\"]");
    return read;
}

std::vector<double> ObjectReader::numbers (std::string_view key)
{
    std::vector<double> read;
    const Json* entries = list (key, "numbers");
    if (entries == nullptr) return read;
    for (const auto& entry : *entries)
        if (entry.is_number() && std::isfinite (entry.get<double>()))
            read.push_back (entry.get<double>());
        else
            error (key, messageId ("kind"), std::string (key) + " must be a list of numbers", "write [1, 2]");
    return read;
}

void ObjectReader::require (std::string_view key, std::string_view remedy)
{
    if (! has (key)) add (Message::error (messageId ("missing"), here, quote (key) + " is missing", std::string (remedy)));
}

void ObjectReader::ignore (std::string_view key) { known.emplace_back (key); }

void ObjectReader::finish()
{
    constexpr std::size_t most_listed = 100;   // of one object: a graph has many, and each message lists the known keys
    std::size_t unknown = 0;
    for (const auto& [key, value] : object_here.items())
        if (std::ranges::find (known, key) == known.end() && ++unknown <= most_listed)
            error (key, messageId ("unknown_key"), quote (key) + " is not a known key here", suggestion (key, known));
    if (unknown > most_listed)
        add (Message::error (messageId ("unknown_key"), here, std::to_string (unknown - most_listed) + " more keys here are not known",
                             "remove all keys that are not known"));
}

}   // namespace tactus
