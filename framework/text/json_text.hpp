// SPDX-License-Identifier: MIT
#pragma once

/// Reads JSON, and records the position of each part, so that every problem of a file can be shown with its line and column.

#include "budget.hpp"
#include "json.hpp"
#include "message.hpp"
#include "text_position.hpp"

#include <string>
#include <string_view>

namespace tactus
{

struct JsonText
{
    Json root;   ///< null if the text could not be read. An object that has a key twice has both members
    TextPositions positions;
    double values = 0.0;   ///< how many numbers, texts, lists and objects were read
    Messages messages;     ///< file/syntax, file/too_deep, file/too_large, file/duplicate_key
};

/// Reads JSON (RFC 8259, UTF-8). Does not throw, and recurses at most `deepest_nesting` times; accepts any text, and refuses one that
/// exceeds the budget `file` or has more values than `most_values`. [any thread]
JsonText readJson (std::string_view text, double most_values = budgets().values);

/// A key in the form used in JSON pointers.
std::string pointerPart (std::string_view key);

/// Appends a key in that form to a JSON pointer that ends with a slash.
void appendPointerPart (std::string& pointer, std::string_view key);

/// The position of the value at a pointer, or of its nearest parent that exists in the file.
TextPosition positionOf (const TextPositions&, std::string_view pointer);

/// Adds a member at the end of an object. Unlike Json, it does not search for the key first, so building an object takes
/// linear time.
void append (Json& object, std::string key, Json value);

}   // namespace tactus
