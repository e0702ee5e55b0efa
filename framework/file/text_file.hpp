// SPDX-License-Identifier: MIT
#pragma once

#include <framework/text/result.hpp>

#include <filesystem>
#include <optional>
#include <string>

namespace tactus
{

/// The content of a small file; empty if it cannot be read. [main thread]
std::optional<std::string> readTextFile (const std::filesystem::path&);

/// Writes a file completely or not at all, and creates its folder. Error: output/unwritable. [main thread]
Result<> writeTextFile (const std::filesystem::path&, const std::string& text);

}   // namespace tactus
