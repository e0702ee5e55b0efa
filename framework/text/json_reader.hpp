// SPDX-License-Identifier: MIT
#pragma once

#include "json_scanner.hpp"
#include "json_text.hpp"
#include "seen_keys.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace tactus
{

/// Reads a file of JSON in one pass. Each function reads one thing where the scanner is. If it is not there, the function says so in a
/// message, unless the caller knows better what was expected, and returns false.
class JsonReader
{
public:
    JsonReader (std::string_view text, JsonText& r, double most) : scan (text), result (r), most_values (most) {}

    bool file();

private:
    /// An object or a list that is being read. Its last entry is being read, too.
    struct Level
    {
        const Level* around = nullptr;
        const Json::Object* members = nullptr;   // null for a list
        const Json::Array* elements = nullptr;
    };

    /// What may be where reading has failed.
    enum class Wanted
    {
        value,
        key,
        colon,
        separator,
        end_of_file
    };

    bool value (Json& into, std::uint32_t place, int depth);
    bool object (Json::Object&, std::uint32_t place, int depth);
    bool member (Json::Object&, SeenKeys&, std::uint32_t place, int depth);
    bool list (Json::Array&, std::uint32_t place, int depth);
    bool number (Json& into);
    bool string (std::string& into);
    bool key (std::string_view& text);

    std::string pathOf (const Level*) const;
    bool refuse (std::string id, std::string where, TextPosition, std::string text, std::string remedy);
    bool syntax (TextPosition, std::string text, std::string remedy);
    bool expected (const std::string& what, Wanted, bool after_comma = false);
    std::string found() const;
    std::string remedyFor (Wanted, bool after_comma) const;
    std::string textWithUnit() const;
    void complainOfTwins (std::string_view key, TextPosition);
    bool tooMany();
    bool tooDeep();

    JsonScanner scan;
    JsonText& result;
    const double most_values;
    const Level* innermost = nullptr;
    bool has_failed = false;   // with a message
    std::string rare_key;      // the last one that was not a plain string
};

}   // namespace tactus
