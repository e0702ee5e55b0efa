// SPDX-License-Identifier: MIT
#pragma once

/// Reads JSON with nlohmann's parser, and records the position of each part, so that every problem of a file can be shown with
/// its line and column.

#include "json.hpp"
#include "message.hpp"
#include "text_position.hpp"

#include <string>
#include <string_view>

namespace tactus
{

inline constexpr std::size_t largest_file = 64u << 20u;   ///< in bytes

struct JsonText
{
    Json root;   ///< null if the text could not be read
    TextPositions positions;
    Messages messages;   ///< file/syntax, file/too_deep, file/too_large, file/duplicate_key
};

/// Reads JSON (RFC 8259, UTF-8). Does not throw or recurse; accepts any text. [any thread]
JsonText readJson (std::string_view text);

/// A key in the form used in JSON pointers.
std::string pointerPart (std::string_view key);

/// The position of the value at a pointer, or of its nearest parent that exists in the file.
TextPosition positionOf (const TextPositions&, std::string_view pointer);

/// Adds a member at the end of an object. Unlike Json, it does not search for the key first, so building an object takes
/// linear time.
void append (Json& object, std::string key, Json value);

}   // namespace tactus
