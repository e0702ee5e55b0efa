// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/message.hpp>

#include <filesystem>
#include <optional>

namespace tactus::host
{

/// The folder for settings, sessions and crash recovery: TACTUS_HOME in the environment, or the system's usual place
/// (~/.config/Tactus, ~/Library/Tactus, %APPDATA%\Tactus). It may not exist. Empty if the user's home is unknown, or if another user
/// can change what is in the folder. [main thread]
std::filesystem::path homeFolder();

/// Why an existing folder is not used, if another user can change what is in it. Id: home/foreign. [main thread]
std::optional<Message> homeTrouble();

}   // namespace tactus::host
