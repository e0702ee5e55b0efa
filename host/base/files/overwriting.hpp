// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/result.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// Checks that no output would replace a file that is read, and that no two outputs are the same file: data would be lost. [any thread]
/// Errors: output/is_input, output/twice.
[[nodiscard]] Result<> checkOverwriting (const std::vector<std::string>& outputs, const std::vector<std::filesystem::path>& inputs);

}   // namespace tactus::host
