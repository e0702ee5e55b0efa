// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// The folder of the programs of Tactus: that of the running program or, if this code is in a shared library, the one that belongs to the library:
/// the library's own, or for an installed library, `bin` next to `lib`. Empty if the system does not provide it. [any thread]
std::filesystem::path programFolder();

/// The path of a program of this name in that folder. It may not exist. [any thread]
std::filesystem::path besideThisProgram (const std::string& name);

/// Starts a program in place of this one, with the same terminal and environment; its exit status becomes that of this process.
/// Returns only if the program cannot be started, and then returns the reason. [main thread]
std::string becomeProgram (const std::filesystem::path&, const std::vector<std::string>& arguments);

}   // namespace tactus::host
