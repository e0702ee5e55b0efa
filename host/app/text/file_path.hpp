// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host
{

/// Resolves a path that is written in a graph stored in `folder`.
std::string resolved (const std::string& path, const std::string& folder);

/// The path to write in a graph: relative to its folder, if it has one.
std::string pathFrom (const std::filesystem::path& file, const std::string& folder);

}   // namespace tactus::host
