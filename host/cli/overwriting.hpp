// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// Ends the command if an output would replace a file that is read, or if two outputs are the same file: data would be
/// lost.
void refuseOverwriting (const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs);

/// Prints which files of these outputs were left by runs that were killed. They are never overwritten.
void reportUnfinished (const std::vector<std::string>& outputs);

}   // namespace tactus::host
