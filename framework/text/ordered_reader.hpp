// SPDX-License-Identifier: MIT
#pragma once

/// Reads the objects of a file member by member, in file order, against a table of the known keys. Unknown keys are kept in order.

#include "json.hpp"
#include "message.hpp"

#include <functional>
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

class OrderedReader
{
public:
    void error (std::string id, const std::string& where, std::string text, std::string remedy = {});
    void warning (std::string id, const std::string& where, std::string text, std::string remedy = {});

    bool isKind (const Json&, JsonKind, const std::string& where);

    /// Reads every member of an object in file order. Passes the value of a known key to its function, if it has the right kind.
    /// Moves unknown members to `extra`, with a warning if the key is probably misspelt.
    void read (Json& object, const std::string& where, const std::vector<KnownKey>&, Json& extra);

    Messages messages;

private:
    void add (Message::Severity, std::string id, const std::string& where, std::string text, std::string remedy);
};

}   // namespace tactus
