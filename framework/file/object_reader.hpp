// SPDX-License-Identifier: MIT
#pragma once

/// Reads the objects of a file key by key, against a table of the keys that are known there.

#include <framework/json.hpp>
#include <framework/message.hpp>

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

/// A key that is known in an object, and what becomes of its value.
struct KnownKey
{
    std::string_view key;
    JsonKind kind;
    std::function<void (Json& value, const std::string& where)> read;
};

class ObjectReader
{
public:
    static constexpr std::size_t most_messages = 1000;   ///< beyond these nobody reads on, and a hostile file has millions

    void error (std::string id, const std::string& where, std::string text, std::string remedy = {});
    void warning (std::string id, const std::string& where, std::string text, std::string remedy = {});

    bool isKind (const Json&, JsonKind, const std::string& where);

    /// Every member of an object in the order of the file: a known key goes to its field, if the value is of its kind;
    /// any other is kept in `extra`.
    void read (Json& object, const std::string& where, const std::vector<KnownKey>&, Json& extra);

    Messages messages;

private:
    void add (Message::Severity, std::string id, const std::string& where, std::string text, std::string remedy);
};

}   // namespace tactus
