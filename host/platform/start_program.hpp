// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// The path of a program of this name in the folder of the running program. It may not exist. [main thread]
std::filesystem::path besideThisProgram (const std::string& name);

/// Starts a program in place of this one, with the same terminal and environment; its exit status becomes that of this process.
/// Returns only if the program cannot be started, and then returns the reason. [main thread]
std::string becomeProgram (const std::filesystem::path&, const std::vector<std::string>& arguments);

}   // namespace tactus::host
