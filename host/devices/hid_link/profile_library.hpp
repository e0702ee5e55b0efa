// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/profile_reader.hpp>

#include <filesystem>
#include <vector>

namespace tactus::host::hid
{

/// The folder of the profiles that come with Tactus: next to the program, installed, or in the source tree. Empty if there is none.
std::filesystem::path profileFolder();

/// The folder of the user's own profiles: TACTUS_PROFILES in the environment, else ~/.config/tactus/profiles. It may not exist.
std::filesystem::path ownProfileFolder();

/// The user's profiles and those that come with Tactus. A user's profile may exceed the limits of a shipped one only if its `replaces`
/// names the shipped one, which is then not used; this gives a warning. Otherwise, a user's profile with the id of a shipped one is not
/// used. A profile that can fit the same device is used only if it sends nothing, or is the same except for names and limits
/// (differenceOf); it then has the limits of both. Ids: the errors profile/shadows and profile/competes, the warnings profile/replaces and profile/competes.
LoadedProfiles joined (LoadedProfiles own, LoadedProfiles shipped);

/// The profiles of a user's folder, unless another user can change them. Ids: profile/foreign, and those of loadProfiles. [main thread]
LoadedProfiles loadOwnProfiles (const std::filesystem::path& folder);

/// All profiles in both folders, joined. [main thread]
LoadedProfiles loadProfileLibrary();

}   // namespace tactus::host::hid
