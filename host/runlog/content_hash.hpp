// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tactus::host
{

/// Tells whether a content is another one than it was: FNV-1a with 64 bits, as 16 hexadecimal digits. No protection against
/// somebody who means to deceive.
std::string contentHash (std::string_view bytes);

/// Of a file; nothing if it cannot be read.
std::optional<std::string> fileHash (const std::filesystem::path&);

}   // namespace tactus::host
