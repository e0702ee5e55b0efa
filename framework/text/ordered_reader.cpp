// SPDX-License-Identifier: MIT
#include "ordered_reader.hpp"

#include "closest_match.hpp"
#include "json_text.hpp"

#include "quote.hpp"

#include <algorithm>

namespace tactus
{
bool matches (const Json& value, JsonKind kind) noexcept
{
    switch (kind)
    {
    case JsonKind::object:
        return value.is_object();
    case JsonKind::list:
        return value.is_array();
    case JsonKind::text:
        return value.is_string();
    case JsonKind::number:
        return value.is_number();
    case JsonKind::truth:
        return value.is_boolean();
    case JsonKind::any:
        break;
    }
    return true;
}

JsonPlace::operator std::string() const
{
    if (around == nullptr) return *text;
    std::string pointer = *around;
    pointer += '/';
    appendPointerPart (pointer, key);
    return pointer;
}

namespace
{
constexpr std::string_view nameOf (JsonKind kind)
{
    switch (kind)
    {
    case JsonKind::object:
        return "an object, {…}";
    case JsonKind::list:
        return "a list, […]";
    case JsonKind::text:
        return "a string in double quotes";
    case JsonKind::number:
        return "a number";
    case JsonKind::truth:
        return "true or false";
    case JsonKind::any:
        break;
    }
    return "a value";
}

std::string_view found (const Json& value)
{
    if (value.is_object()) return "an object, {…}";
    if (value.is_array()) return "a list, […]";
    if (value.is_string()) return "a string";
    if (value.is_number()) return "a number";
    return value.is_null() ? "null" : "true or false";
}

/// The name of a value in a message: the last key or index of its pointer.
std::string lastPart (const std::string& where)
{
    const auto part = where.substr (where.rfind ('/') + 1);
    return ! part.empty() && std::ranges::all_of (part, [] (char c) { return c >= '0' && c <= '9'; })
               ? "entry " + part
               : quote (part);
}
}   // namespace

void OrderedReader::error (std::string id, const std::string& where, std::string text, std::string remedy)
{
    add (Message::Severity::error, std::move (id), where, std::move (text), std::move (remedy));
}

void OrderedReader::warning (std::string id, const std::string& where, std::string text, std::string remedy)
{
    add (Message::Severity::warning, std::move (id), where, std::move (text), std::move (remedy));
}

void OrderedReader::add (Message::Severity severity, std::string id, const std::string& where, std::string text, std::string remedy)
{
    if (messages.size() == most_messages)
    {
        severity = Message::Severity::error;
        id = "file/more";
        text = "there are more problems than the " + std::to_string (most_messages) + " that are listed";
        remedy = "fix these first";
    }
    if (messages.size() > most_messages) return;

    const auto make = severity == Message::Severity::error ? &Message::error : &Message::warning;
    messages.push_back (make (std::move (id), where, std::move (text), std::move (remedy)));
}

bool OrderedReader::isKind (const Json& value, JsonKind kind, const std::string& where)
{
    if (matches (value, kind)) return true;
    const auto wanted = std::string (nameOf (kind));
    error ("file/wrong_kind", where, lastPart (where) + " should be " + wanted + ", but is " + std::string (found (value)), "write " + wanted);
    return false;
}

void OrderedReader::read (Json& object, const std::string& where, const std::vector<KnownKey>& fields, Json& extra)
{
    const JsonPlace around (where);
    for (auto& [key, value] : object.asObject())
    {
        const std::string member = JsonPlace (around, key);
        const auto field = std::ranges::find (fields, key, &KnownKey::key);
        if (field != fields.end())
        {
            if (isKind (value, field->kind, member)) field->read (value, member);
            continue;
        }
        std::vector<std::string_view> known (fields.size());
        std::ranges::transform (fields, known.begin(), &KnownKey::key);
        keepUnknown (key, std::move (value), member, known, extra);
    }
}

void OrderedReader::keepUnknown (const std::string& key, Json value, const std::string& member, std::span<const std::string_view> known, Json& extra)
{
    if (const auto meant = closestMatch (key, known); ! meant.empty())
        warning ("file/unknown_key", member, "the key " + quote (key) + " is unknown and has no effect; did you mean '" + std::string (meant) + "'?",
                 "write '" + std::string (meant) + "', or leave the key as it is");
    append (extra, key, std::move (value));
}

}   // namespace tactus
