// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>

#include <framework/json.hpp>
#include <framework/message.hpp>

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

/// Reads a profile and tells everything that is wrong with it. `where` is a JSON pointer; from a text, line and column
/// are told as well. [main thread]
///
/// Ids: profile/kind, profile/unit, profile/out_of_range, profile/missing, profile/unknown_key, profile/format,
/// profile/hex, profile/type, profile/beyond, profile/overlap, profile/name, profile/duplicate, profile/unknown_name,
/// profile/no_neutral, profile/too_many, profile/axes, profile/kinematics; and file/… of readJson.
LoadedProfile readProfile (const Json&);
LoadedProfile readProfileText (std::string_view text);

struct LoadedProfiles
{
    std::vector<std::shared_ptr<const Profile>> profiles;   ///< by file name
    Messages messages;                                      ///< `file` says of which; a bad profile does not keep the others away
};

/// All *.json of a folder but the schema. profile/unreadable if there is no such folder or a file cannot be read;
/// profile/duplicate for the second of two with one id. [main thread]
LoadedProfiles loadProfiles (const std::filesystem::path& folder);

}   // namespace tactus::host::hid
