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

/// All profiles in both folders. A user's profile replaces a profile of Tactus with the same id. [main thread]
LoadedProfiles loadProfileLibrary();

}   // namespace tactus::host::hid
