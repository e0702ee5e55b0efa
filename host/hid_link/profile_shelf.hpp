// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile_reader.hpp>

#include <filesystem>
#include <vector>

namespace tactus::host::hid
{

/// Where the profiles that come with Tactus are: beside the program, installed, or in the source tree. Empty if nowhere.
std::filesystem::path profileFolder();

/// Where people keep their own: TACTUS_PROFILES in the environment, or ~/.config/tactus/profiles. It need not be there.
std::filesystem::path ownProfileFolder();

/// All of both. One of the own ones takes the place of one that comes with Tactus and has its id. [main thread]
LoadedProfiles profilesAtHand();

}   // namespace tactus::host::hid
