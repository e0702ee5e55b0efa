// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace tactus
{

/// Writes a file through a temporary one beside it, so that a crash leaves the old file or the new one, never half of
/// it. Links stay links, and permissions stay. Returns the reason if it did not work; then nothing has changed.
std::optional<std::string> writeWhole (const std::filesystem::path&, std::string_view text);

}   // namespace tactus
