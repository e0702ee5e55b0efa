// SPDX-License-Identifier: GPL-3.0-or-later
#include "profile_library.hpp"
#include <framework/text/quote.hpp>
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

LoadedProfiles joined (LoadedProfiles own, LoadedProfiles shipped)
{
    auto all = std::move (shipped);
    for (auto& profile : own.profiles)
    {
        const auto same = std::ranges::find (all.profiles, profile->id, &Profile::id);
        const auto note = [&] (Message m) {
            m.file = profile->file;
            all.messages.push_back (std::move (m));
        };
        if (same == all.profiles.end())
            all.profiles.push_back (std::move (profile));
        else if (profile->replaces != profile->id)
            note (Message::error ("profile/shadows", "/id", "the profile has the id of a shipped one, " + quote (profile->id) + ", so it is not used",
                                  "give it another id; or, to use it instead of the shipped one and its limits, add \"replaces\": \"" + profile->id + '"'));
        else
        {
            note (Message::warning ("profile/replaces", "/replaces", "the profile replaces the shipped profile " + quote (profile->id) + " and its limits",
                                    "remove this file to use the shipped profile"));
            *same = std::move (profile);
        }
    }
    std::ranges::move (own.messages, std::back_inserter (all.messages));
    return all;
}

LoadedProfiles loadProfileLibrary()
{
    LoadedProfiles own, shipped;
    if (const auto folder = ownProfileFolder(); ! folder.empty() && isFolder (folder)) own = loadProfiles (folder);
    if (const auto folder = profileFolder(); ! folder.empty()) shipped = loadProfiles (folder);
    return joined (std::move (own), std::move (shipped));
}

}   // namespace tactus::host::hid
