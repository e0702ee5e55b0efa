// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The facts that a developer needs about a computer to find out why ticks are late there: name and text of each fact, such as "locked memory" and
/// "limit 8192 KiB". It contains no name of a user or of the computer. What the system does not tell is left out. [any thread]
std::vector<std::pair<std::string, std::string>> systemFacts();

}   // namespace tactus::host
