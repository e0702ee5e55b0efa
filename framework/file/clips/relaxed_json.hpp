// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/json_text.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tactus::readers
{

/// A habit of real files that JSON does not allow, and where it first occurs.
struct Habit
{
    std::string what;   ///< "commas before a closing bracket"
    int count = 0;
    TextPosition first;
};

struct RelaxedJson
{
    JsonText json;
    std::vector<Habit> habits;   ///< those of this file; empty if it is plain JSON
};

/// Reads JSON, and accepts what programs and people add to it: commas before a closing bracket, comments, keys without quotation
/// marks, text in single quotes, plus signs, and numbers such as .5 and 5. (the parts of JSON5 that clip files use). Everything else
/// is an error of readJson. Positions are those in the given text. Accepts any text. [any thread]
RelaxedJson readRelaxedJson (std::string_view text);

}   // namespace tactus::readers
