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
    void (*read) (Reader&, Read&, Json& value, const std::string& where);
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
    void read (Json& object, const std::string& where, const RowKey<Reader, Read> (&fields)[n], Reader& self, Read& into, Json& extra)
    {
        MemberPointer pointer (*this, where);
        for (auto& [key, value] : object.asObject())
        {
            const auto& member = pointer.to (key);
            const auto* field = std::ranges::find (fields, key, &RowKey<Reader, Read>::key);
            if (field == std::end (fields))
            {
                std::string_view known[n];
                std::ranges::transform (fields, known, &RowKey<Reader, Read>::key);
                keepUnknown (key, std::move (value), member, known, extra);
            }
            else if (isKind (value, field->kind, member))
                field->read (self, into, value, member);
        }
    }

    Messages messages;

protected:
    /// The JSON pointer to one member of an object after another. Most files have no errors, so these are rarely looked at, and must be
    /// cheap: the reader keeps their memory for the next object.
    class MemberPointer
    {
    public:
        MemberPointer (OrderedReader& r, const std::string& object) : reader (r)
        {
            if (! reader.spare.empty())
            {
                text = std::move (reader.spare.back());
                reader.spare.pop_back();
            }
            text = object;
            text += '/';
            begin = text.size();
        }
        ~MemberPointer() { reader.spare.push_back (std::move (text)); }
        MemberPointer (const MemberPointer&) = delete;
        MemberPointer& operator= (const MemberPointer&) = delete;

        /// Valid until the next call.
        const std::string& to (std::string_view key)
        {
            text.resize (begin);
            appendPointerPart (text, key);
            return text;
        }

    private:
        OrderedReader& reader;
        std::string text;
        std::size_t begin = 0;   // of the key
    };

private:
    std::vector<std::string> spare;   // for MemberPointer

    void keepUnknown (const std::string& key, Json value, const std::string& member, std::span<const std::string_view> known, Json& extra);
    void add (Message::Severity, std::string id, const std::string& where, std::string text, std::string remedy);
};

}   // namespace tactus
