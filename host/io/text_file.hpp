// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tactus::host
{

/// All of a small file; nothing if it cannot be read. [main thread]
std::optional<std::string> readTextFile (const std::filesystem::path&);

/// Writes it whole or not at all, and makes its folder. Returns why not, if not. [main thread]
std::optional<std::string> writeTextFile (const std::filesystem::path&, const std::string& text);

}   // namespace tactus::host
