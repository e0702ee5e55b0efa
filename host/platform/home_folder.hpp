// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace tactus::host
{

/// The folder for settings, sessions and crash recovery: TACTUS_HOME in the environment, or the system's usual place
/// (~/.config/Tactus, ~/Library/Tactus, %APPDATA%\Tactus). It may not exist. Empty if the user's home is unknown.
/// [main thread]
std::filesystem::path homeFolder();

}   // namespace tactus::host
