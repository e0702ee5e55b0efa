// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>

namespace tactus
{

/// A position in text, counted from 1. Columns count characters, not bytes.
struct TextPosition
{
    int line = 1, column = 1;

    bool operator== (const TextPosition&) const = default;
};

/// The position of each key and element of a file, by JSON pointer. Of long lists of numbers or rows, only the first 1000 entries
/// are kept; beyond these, the position of the list is good enough.
using TextPositions = std::map<std::string, TextPosition, std::less<>>;

}   // namespace tactus
