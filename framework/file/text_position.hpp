// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>

namespace tactus
{

/// Counted from 1; a column is a character, not a byte.
struct TextPosition
{
    int line = 1, column = 1;

    bool operator== (const TextPosition&) const = default;
};

/// Where each key and element of a file stands, by JSON pointer. Of long lists of numbers or rows only the first 1000
/// entries are kept: bulk data, whose list is near enough.
using TextPositions = std::map<std::string, TextPosition, std::less<>>;

}   // namespace tactus
