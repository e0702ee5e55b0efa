// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/text/message.hpp>

#include <filesystem>
#include <optional>

namespace tactus::host
{

/// The folder for settings, sessions and crash recovery: TACTUS_HOME in the environment, or the system's usual place
/// (Tactus in XDG_CONFIG_HOME or ~/.config, ~/Library/Tactus, %APPDATA%\Tactus). It may not exist. Empty if the user's home is unknown, or if another user
/// can change what is in the folder. [main thread]
std::filesystem::path homeFolder();

/// The folder for what lasts only as long as programs run: tactus in XDG_RUNTIME_DIR, or run in homeFolder(). Like that, it may not exist, or be empty.
/// [main thread]
std::filesystem::path runFolder();

/// The user's documents on Linux: XDG_DOCUMENTS_DIR in the environment or in user-dirs.dirs, or ~/Documents. It may not exist. Empty on other
/// systems, or if the user's home is unknown. [main thread]
std::filesystem::path documentsFolder();

/// The reason why an existing folder is not used: another user can change what is in it. Empty if it is used. Id: home/foreign. [main thread]
std::optional<Message> homeTrouble();

}   // namespace tactus::host
