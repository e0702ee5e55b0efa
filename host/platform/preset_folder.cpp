// SPDX-License-Identifier: GPL-3.0-or-later
#include "preset_folder.hpp"

#include "device_file.hpp"

#include <cstdlib>
#include <system_error>

namespace tactus::host
{

namespace fs = std::filesystem;

fs::path presetFolder()
{
    if (const char* given = std::getenv ("TACTUS_PRESETS"); given != nullptr && *given != 0) return given;
    const auto program = programFolder();
    std::error_code failed;
    for (const auto* place : { "graphs", "../share/tactus/graphs", "../../../graphs", "../graphs" })
        if (const auto folder = (program / place).lexically_normal(); ! program.empty() && fs::is_directory (folder, failed)) return folder;
    return {};
}

std::string graphFile (const std::string& argument)
{
    const fs::path given (argument);
    std::error_code failed;
    if (argument.empty() || given.has_parent_path() || given.has_extension() || fs::exists (given, failed)) return argument;
    const auto preset = presetFolder() / (argument + ".json");
    return fs::is_regular_file (preset, failed) ? preset.string() : argument;
}

}   // namespace tactus::host
