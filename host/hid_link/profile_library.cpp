// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile_library.hpp"
#include <host/platform/device_file.hpp>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <system_error>
#include <utility>

namespace tactus::host::hid
{
namespace fs = std::filesystem;

namespace
{
/// Also false for a folder that the user has no permission to read.
bool isFolder (const fs::path& path)
{
    std::error_code forbidden;
    return fs::is_directory (path, forbidden);
}
}   // namespace

fs::path profileFolder()
{
    const auto program = programFolder();
    for (const auto* place : { "profiles", "../share/tactus/profiles", "../../../host/profiles" })
        if (const auto folder = (program / place).lexically_normal(); ! program.empty() && isFolder (folder)) return folder;
    return {};
}

fs::path ownProfileFolder()
{
    if (const char* given = std::getenv ("TACTUS_PROFILES"); given != nullptr && *given != 0) return given;
    if (const char* config = std::getenv ("XDG_CONFIG_HOME"); config != nullptr && *config != 0) return fs::path (config) / "tactus/profiles";
    if (const char* home = std::getenv ("HOME"); home != nullptr && *home != 0) return fs::path (home) / ".config/tactus/profiles";
    return {};
}

LoadedProfiles loadProfileLibrary()
{
    LoadedProfiles all;
    if (const auto own = ownProfileFolder(); ! own.empty() && isFolder (own)) all = loadProfiles (own);
    if (const auto folder = profileFolder(); ! folder.empty())
    {
        auto ours = loadProfiles (folder);
        const auto own = all.profiles;
        std::ranges::copy_if (ours.profiles, std::back_inserter (all.profiles),
                              [&] (const auto& p) { return std::ranges::none_of (own, [&] (const auto& o) { return o->id == p->id; }); });
        std::ranges::move (ours.messages, std::back_inserter (all.messages));
    }
    return all;
}

}   // namespace tactus::host::hid
