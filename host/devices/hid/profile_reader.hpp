// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"

#include <tactus/text/json.hpp>
#include <tactus/text/message.hpp>

#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

namespace tactus::host::hid
{

struct LoadedProfile
{
    std::shared_ptr<const Profile> profile;   ///< null if there are errors
    Messages messages;
};

/// Reads a profile and reports all problems. `where` is a JSON pointer; if the profile was read from text, line and column are
/// set too. [main thread]
///
/// Ids: profile/kind, profile/unit, profile/out_of_range, profile/missing, profile/unknown_key, profile/format,
/// profile/hex, profile/type, profile/beyond, profile/overlap, profile/name, profile/duplicate, profile/unknown_name,
/// profile/no_neutral, profile/too_many, profile/axes, profile/kinematics; and file/… of readJson.
LoadedProfile readProfile (const Json&);
LoadedProfile readProfileText (std::string_view text);

struct LoadedProfiles
{
    std::vector<std::shared_ptr<const Profile>> profiles;   ///< sorted by file name
    Messages messages;                                      ///< `file` names the profile; a bad profile does not affect the others
};

/// The profile with this id; null if there is none.
std::shared_ptr<const Profile> profileNamed (const LoadedProfiles&, std::string_view id);

/// Loads all *.json files of a folder except schemas. Of a user's own folder, only those that no other user can change. Ids:
/// profile/unreadable if the folder or a file cannot be read; profile/foreign if another user can change a file; profile/duplicate for a
/// second profile with the same id. [main thread]
LoadedProfiles loadProfiles (const std::filesystem::path& folder, bool are_own = false);

}   // namespace tactus::host::hid
