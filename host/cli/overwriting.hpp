// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// Ends the command if an output would replace a file that is read, or two outputs are one file: what was in it would be lost.
void refuseOverwriting (const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs);

}   // namespace tactus::host
