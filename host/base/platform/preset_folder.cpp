// SPDX-License-Identifier: MIT
#include "preset_folder.hpp"

#include "start_program.hpp"

#include <algorithm>
#include <cstdlib>
#include <system_error>

#if ! defined(_WIN32)
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace tactus::host
{

namespace fs = std::filesystem;

namespace
{
#if defined(_WIN32)
bool comesWith (const fs::path&, const fs::path&)
{
    return true;
}
#else
bool isOpenToAll (const struct stat& s)
{
    return ! S_ISLNK (s.st_mode) && (s.st_mode & S_IWOTH) != 0;
}

bool comesWith (const fs::path& program_folder, const fs::path& place)
{
    auto [program_part, part] = std::mismatch (program_folder.begin(), program_folder.end(), place.begin(), place.end());
    fs::path at;
    for (auto common = program_folder.begin(); common != program_part; ++common)
        at /= *common;
    struct stat common
    {
    };
    struct stat own = common;
    if (::stat (at.c_str(), &common) != 0) return false;
    if (::stat (program_folder.c_str(), &own) != 0) own = {};   // a library that was installed without programs
    for (; part != place.end(); ++part)
    {
        at /= *part;
        struct stat s
        {
        };
        if (::lstat (at.c_str(), &s) != 0) return false;
        if (s.st_uid != ::geteuid() && s.st_uid != 0 && s.st_uid != common.st_uid) return false;
        if (isOpenToAll (s) && ! isOpenToAll (own)) return false;   // where all can replace the program, this is no way around anything
    }
    return true;
}
#endif
}   // namespace

fs::path shippedWith (const fs::path& program_folder, const std::vector<std::string>& places)
{
    std::error_code failed;
    for (const auto& place : places)
        if (auto path = (program_folder / place).lexically_normal(); fs::exists (path, failed) && comesWith (program_folder, path)) return path;
    return {};
}

fs::path shipped (const std::vector<std::string>& places)
{
    const auto program = programFolder();
    return program.empty() ? program : shippedWith (program, places);
}

fs::path presetFolder()
{
    if (const char* given = std::getenv ("TACTUS_PRESETS"); given != nullptr && *given != 0) return given;
    return shipped ({ "graphs", "../share/tactus/graphs", "../../../graphs", "../graphs" });
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
