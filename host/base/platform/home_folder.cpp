// SPDX-License-Identifier: MIT
#include "home_folder.hpp"

#include <tactus/text/ownership.hpp>

#include <cstdlib>
#include <fstream>
#include <string>
#include <string_view>

#if ! defined(_WIN32)
#include <pwd.h>
#include <unistd.h>
#endif

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

fs::path fromEnvironment (const char* name)
{
    const char* told = std::getenv (name);
    return told != nullptr ? fs::path (told) : fs::path();
}

#if ! defined(_WIN32)
fs::path folderOfUser()
{
    auto home = fromEnvironment ("HOME");
    if (! home.is_absolute()) home.clear();   // it would be in the folder of whatever graph is played
    if (home.empty())
        if (const auto* user = ::getpwuid (::getuid()); user != nullptr && user->pw_dir != nullptr) home = user->pw_dir;
    return home;
}
#endif

fs::path configurations()
{
#if defined(_WIN32)
    return fromEnvironment ("APPDATA");
#elif defined(__APPLE__)
    const auto home = folderOfUser();
    return home.empty() ? home : home / "Library";
#else
    if (auto told = fromEnvironment ("XDG_CONFIG_HOME"); told.is_absolute()) return told;
    const auto home = folderOfUser();
    return home.empty() ? home : home / ".config";
#endif
}

fs::path usualHome()
{
    if (auto told = fromEnvironment ("TACTUS_HOME"); ! told.empty()) return told;
    const auto folder = configurations();
    return folder.empty() ? folder : folder / "Tactus";
}
}   // namespace

std::filesystem::path homeFolder()
{
    const auto folder = usualHome();
    return folder.empty() || whoElseCanChange (folder).empty() ? folder : fs::path();
}

std::filesystem::path runFolder()
{
    if (const auto told = fromEnvironment ("XDG_RUNTIME_DIR"); told.is_absolute()) return told / "tactus";
    const auto home = homeFolder();
    return home.empty() ? home : home / "run";
}

std::filesystem::path documentsFolder()
{
#if defined(_WIN32) || defined(__APPLE__)
    return {};
#else
    if (auto told = fromEnvironment ("XDG_DOCUMENTS_DIR"); told.is_absolute()) return told;
    const auto home = folderOfUser();
    std::ifstream listed (configurations() / "user-dirs.dirs");
    for (std::string line; std::getline (listed, line);)   // XDG_DOCUMENTS_DIR="$HOME/Papers"
    {
        constexpr std::string_view key = "XDG_DOCUMENTS_DIR=\"", of_home = "$HOME/";
        if (! line.starts_with (key) || line.size() <= key.size() || line.back() != '"') continue;
        const auto told = line.substr (key.size(), line.size() - key.size() - 1);
        const fs::path folder = told.starts_with (of_home) ? home / told.substr (of_home.size()) : fs::path (told);
        if (folder.is_absolute()) return folder;
    }
    return home.empty() ? home : home / "Documents";
#endif
}

std::optional<Message> homeTrouble()
{
    const auto folder = usualHome();
    std::error_code unseen;
    if (folder.empty() || ! fs::exists (folder, unseen)) return std::nullopt;
    auto who = whoElseCanChange (folder);
    if (who.empty()) return std::nullopt;
    return Message::warning ("home/foreign", folder.string(), std::move (who) + ", so settings, sessions and plugins there are not used",
                             "change its owner or its permissions (chown, chmod go-w), or set TACTUS_HOME to a folder of your own");
}

}   // namespace tactus::host
