// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host
{

/// The folder of the presets that come with Tactus: TACTUS_PRESETS in the environment, or next to the program, built or
/// installed. Empty if there is none. [any thread]
std::filesystem::path presetFolder();

/// The graph file that an argument of a command names: the argument itself, or, if it is a bare name such as dry_wood and no file is
/// called that, the preset dry_wood.json. [any thread]
std::string graphFile (const std::string& argument);

}   // namespace tactus::host
