// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>

namespace tactus::host
{

/// Where settings, sessions and what is kept for a crash are: TACTUS_HOME in the environment, or where the system has such
/// things (~/.config/Tactus, ~/Library/Tactus, %APPDATA%\Tactus). It need not be there. Empty if nobody says where a user's
/// files are. [main thread]
std::filesystem::path homeFolder();

}   // namespace tactus::host
