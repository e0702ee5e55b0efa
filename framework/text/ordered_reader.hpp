// SPDX-License-Identifier: MIT
#pragma once

/// Reads the objects of a file member by member, in file order, against a table of the known keys. Unknown keys are kept in order.

#include "json.hpp"
#include "json_text.hpp"
#include "message.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus
{

enum class JsonKind
{
    object,
    list,
    text,
    number,
    truth,
    any
};

bool matches (const Json&, JsonKind) noexcept;

/// The JSON pointer to a value. It becomes text only where it is passed as a string: most files have no errors, so the text is rarely
/// needed. What it is made from must outlive it.
class JsonPlace
{
public:
    JsonPlace (const std::string& pointer) noexcept : text (&pointer) {}   // implicit: a function that takes a JsonPlace also takes the text
    JsonPlace (const JsonPlace& object, std::string_view k) noexcept : around (&object), key (k) {}
    JsonPlace (const JsonPlace&& object, std::string_view) = delete;
    JsonPlace (const JsonPlace&) = delete;
    JsonPlace& operator= (const JsonPlace&) = delete;

    operator std::string() const;

private:
    const std::string* text = nullptr;
    const JsonPlace* around = nullptr;   // the object that the value is a member of; null if `text` is all
    std::string_view key;
};

/// A known key of an object, its kind, and the function that takes its value.
struct KnownKey
{
    std::string_view key;
    JsonKind kind;
    std::function<void (Json& value, const std::string& where)> read;
};

/// A known key of an object that a file has many of, so that no table of functions can be made for each.
template <typename Reader, typename Read>
struct RowKey
{
    std::string_view key;
    JsonKind kind;
    void (*read) (Reader&, Read&, Json& value, const JsonPlace& where);
};

class OrderedReader
{
public:
    void error (std::string id, const std::string& where, std::string text, std::string remedy = {});
    void warning (std::string id, const std::string& where, std::string text, std::string remedy = {});

    bool isKind (const Json&, JsonKind, const std::string& where);

    /// Reads every member of an object in file order. Passes the value of a known key to its function, if it has the right kind.
    /// Moves unknown members to `extra`, with a warning if the key is probably misspelt.
    void read (Json& object, const std::string& where, const std::vector<KnownKey>&, Json& extra);

    /// The same. The functions get `self`, which is this reader, and what they read into.
    template <typename Reader, typename Read, std::size_t n>
    void read (Json& object, const JsonPlace& where, const RowKey<Reader, Read> (&fields)[n], Reader& self, Read& into, Json& extra)
    {
        for (auto& [key, value] : object.asObject())
        {
            const JsonPlace member (where, key);
            const auto* field = std::ranges::find (fields, key, &RowKey<Reader, Read>::key);
            if (field == std::end (fields))
            {
                std::string_view known[n];
                std::ranges::transform (fields, known, &RowKey<Reader, Read>::key);
                keepUnknown (key, std::move (value), member, known, extra);
            }
            else if (matches (value, field->kind) || isKind (value, field->kind, member))
                field->read (self, into, value, member);
        }
    }

    Messages messages;

private:
    void keepUnknown (const std::string& key, Json value, const std::string& member, std::span<const std::string_view> known, Json& extra);
    void add (Message::Severity, std::string id, const std::string& where, std::string text, std::string remedy);
};

}   // namespace tactus
