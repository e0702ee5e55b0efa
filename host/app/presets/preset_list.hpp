// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// What a preset says of itself.
struct Preset
{
    std::filesystem::path file;
    std::string name, about;
    std::vector<std::string> tags;
    std::string problem;   ///< why it cannot be read; else empty
};

/// The presets of a folder, by name. Files that are no graphs are left out; graphs that cannot be read say why. [main thread]
std::vector<Preset> presetsIn (const std::filesystem::path& folder);

/// Where the presets that come with Tactus are: TACTUS_PRESETS in the environment, or beside the program, built or installed.
/// Empty if nowhere.
std::filesystem::path presetFolder();

/// Those that have all words of the query in their name, tags or sentence.
std::vector<Preset> matching (const std::vector<Preset>&, const std::string& query);

}   // namespace tactus::host
