// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

/// The first of these paths, relative to a folder, that leads to something which comes with the program in that folder: below what both
/// have above them, everything belongs to this user, to root, or to the owner of that, and only they can write to it. So a folder that
/// another user makes in /tmp is not taken for a part of a program below /tmp. Empty if there is none. [any thread]
std::filesystem::path shippedWith (const std::filesystem::path& program_folder, const std::vector<std::string>& places);

/// The same for the running program. [any thread]
std::filesystem::path shipped (const std::vector<std::string>& places);

/// The folder of the presets that come with Tactus: TACTUS_PRESETS in the environment, or next to the program, built or
/// installed. Empty if there is none. [any thread]
std::filesystem::path presetFolder();

/// The graph file that an argument of a command names: the argument itself, or, if it is a bare name such as dry_wood and no file is
/// called that, the preset dry_wood.json. [any thread]
std::string graphFile (const std::string& argument);

}   // namespace tactus::host
