// SPDX-License-Identifier: MIT
#include "object_reader.hpp"

#include "json_text.hpp"
#include <framework/near_miss.hpp>

#include <framework/in_quotes.hpp>

#include <algorithm>

namespace tactus
{
namespace
{
bool matches (const Json& value, JsonKind kind)
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

constexpr std::string_view nameOf (JsonKind kind)
{
    switch (kind)
    {
    case JsonKind::object:
        return "an object, {…}";
    case JsonKind::list:
        return "a list, […]";
    case JsonKind::text:
        return "a text in double quotes";
    case JsonKind::number:
        return "a number";
    case JsonKind::truth:
        return "true or false";
    case JsonKind::any:
        break;
    }
    return "a value";
}

constexpr std::string_view found (const Json& value)
{
    if (value.is_object()) return "an object, {…}";
    if (value.is_array()) return "a list, […]";
    if (value.is_string()) return "a text";
    if (value.is_number()) return "a number";
    return value.is_null() ? "null" : "true or false";
}

/// What a message calls a value: the last key or index of its pointer.
std::string lastPart (const std::string& where)
{
    const auto part = where.substr (where.rfind ('/') + 1);
    return ! part.empty() && std::ranges::all_of (part, [] (char c)
                                                  { return c >= '0' && c <= '9'; })
               ? "entry " + part
               : inQuotes (part);
}
}   // namespace

void ObjectReader::error (std::string id, const std::string& where, std::string text, std::string remedy)
{
    add (Message::Severity::error, std::move (id), where, std::move (text), std::move (remedy));
}

void ObjectReader::warning (std::string id, const std::string& where, std::string text, std::string remedy)
{
    add (Message::Severity::warning, std::move (id), where, std::move (text), std::move (remedy));
}

void ObjectReader::add (Message::Severity severity, std::string id, const std::string& where, std::string text, std::string remedy)
{
    if (messages.size() == most_messages)
    {
        severity = Message::Severity::error;
        id = "file/more";
        text = "there are more problems than the " + std::to_string (most_messages) + " that are listed";
        remedy = "mend these first";
    }
    if (messages.size() > most_messages) return;

    Message m;
    m.severity = severity;
    m.id = std::move (id);
    m.where = where;
    m.text = std::move (text);
    m.remedy = std::move (remedy);
    messages.push_back (std::move (m));
}

bool ObjectReader::isKind (const Json& value, JsonKind kind, const std::string& where)
{
    if (matches (value, kind)) return true;
    const auto wanted = std::string (nameOf (kind));
    error ("file/wrong_kind", where, lastPart (where) + " should be " + wanted + ", and is " + std::string (found (value)), "write " + wanted);
    return false;
}

void ObjectReader::read (Json& object, const std::string& where, const std::vector<KnownKey>& fields, Json& extra)
{
    for (auto& [key, value] : object.get_ref<Json::object_t&>())
    {
        const auto member = where + '/' + pointerPart (key);
        const auto field = std::ranges::find (fields, key, &KnownKey::key);
        if (field != fields.end())
        {
            if (isKind (value, field->kind, member)) field->read (value, member);
            continue;
        }
        std::vector<std::string_view> known (fields.size());
        std::ranges::transform (fields, known.begin(), &KnownKey::key);
        if (const auto meant = nearMiss (key, known); ! meant.empty())
            warning ("file/unknown_key", member, "the key " + inQuotes (key) + " means nothing here and is only kept; is '" + std::string (meant) + "' meant?", "write '" + std::string (meant) + "', or leave it");
        append (extra, key, std::move (value));
    }
}

}   // namespace tactus
