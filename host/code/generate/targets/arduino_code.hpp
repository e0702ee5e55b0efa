// SPDX-License-Identifier: MIT
#pragma once

#include <host/code/generate/class/exported.hpp>

#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The files that make an exported class an Arduino library, apart from the class itself, which is in src/: the description, the board
/// report of docs/devices.md, and a sketch. The graph must have a role.
std::vector<std::pair<std::string, std::string>> arduinoFiles (const Exported&);

}   // namespace tactus::host
