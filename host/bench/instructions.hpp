// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <variant>

namespace tactus::bench
{

/// Instructions per tick, for the first and the second variant of a contest.
struct Counted
{
    double first = 0.0, second = 0.0;
};

/// Runs this program again under valgrind and counts. No clock is involved, so the numbers are the same each time. Returns the
/// counts by contest key, or a sentence that says what went wrong. [message thread]
std::variant<std::map<std::string, Counted>, std::string> countInstructions();

/// The part that valgrind counts, in the program that it runs. [message thread]
void runToBeCounted();

/// The option that makes the program call runToBeCounted.
inline constexpr const char* counted_option = "--counted";

}   // namespace tactus::bench
