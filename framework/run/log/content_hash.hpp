// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tactus
{

/// A hash that shows whether content has changed: 64-bit FNV-1a as 16 hexadecimal digits. It does not protect
/// against deliberate changes.
std::string contentHash (std::string_view bytes);

/// The hash of a file; empty if it cannot be read.
std::optional<std::string> fileHash (const std::filesystem::path&);

}   // namespace tactus
