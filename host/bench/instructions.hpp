// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <string>
#include <variant>

namespace tactus::bench
{

/// Instructions of a tick, of the first and the second of a contest.
struct Counted
{
    double first = 0.0, second = 0.0;
};

/// Runs this program once more under valgrind and counts: no clock, so the same each time. Keys as of the contests; or a
/// sentence that says what went wrong. [message thread]
std::variant<std::map<std::string, Counted>, std::string> countInstructions();

/// What is counted, in the program that valgrind runs. [message thread]
void runToBeCounted();

/// The option under which the command line calls runToBeCounted.
inline constexpr const char* counted_option = "--counted";

}   // namespace tactus::bench
