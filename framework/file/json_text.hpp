// SPDX-License-Identifier: MIT
#pragma once

/// JSON as text with positions: what nlohmann's parser reads, and where in the text each part of it stands, so that
/// every problem of a file can be shown at its line and column.

#include "text_position.hpp"

#include <framework/json.hpp>
#include <framework/message.hpp>

#include <string>
#include <string_view>

namespace tactus
{

inline constexpr int deepest_nesting = 64;
inline constexpr std::size_t largest_file = 64u << 20u;   ///< bytes

struct JsonText
{
    Json root;   ///< null if the text could not be read
    TextPositions positions;
    Messages messages;   ///< file/syntax, file/too_deep, file/too_large, file/duplicate_key
};

/// Reads a JSON text (RFC 8259, UTF-8). Never throws, does not recurse; text may be anything. [any thread]
JsonText readJson (std::string_view text);

/// A key as it stands in a JSON pointer.
std::string pointerPart (std::string_view key);

/// The position of a pointer or of its nearest parent that stands in the file.
TextPosition positionOf (const TextPositions&, std::string_view pointer);

/// Puts a member at the end of an object, without looking for the key as Json does: building stays linear.
void append (Json& object, std::string key, Json value);

}   // namespace tactus
