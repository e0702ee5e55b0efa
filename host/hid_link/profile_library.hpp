// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile_reader.hpp>

#include <filesystem>
#include <vector>

namespace tactus::host::hid
{

/// The folder of the profiles that come with Tactus: next to the program, installed, or in the source tree. Empty if there is none.
std::filesystem::path profileFolder();

/// The folder of the user's own profiles: TACTUS_PROFILES in the environment, else ~/.config/tactus/profiles. It may not exist.
std::filesystem::path ownProfileFolder();

/// The user's own profiles and those that come with Tactus. An own one with the id of a shipped one is used only if its `replaces`
/// says so, and then with a warning, because it also replaces the limits. Ids: profile/shadows, profile/replaces.
LoadedProfiles joined (LoadedProfiles own, LoadedProfiles shipped);

/// All profiles in both folders, joined. [main thread]
LoadedProfiles loadProfileLibrary();

}   // namespace tactus::host::hid
