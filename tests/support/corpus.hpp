// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>

namespace tactus::test
{

/// Runs every file of a fuzzing corpus through a target, which aborts if it finds a bug. Returns the number of files.
inline int replay (const std::string& name, void (*target) (std::string_view))
{
    int files = 0;
    for (const auto& entry : std::filesystem::directory_iterator (std::filesystem::path (TACTUS_SOURCE_DIR) / "tests" / "fuzz" / "corpus" / name))
    {
        std::ostringstream text;
        text << std::ifstream (entry.path(), std::ios::binary).rdbuf();
        target (text.str());
        ++files;
    }
    return files;
}

}   // namespace tactus::test
