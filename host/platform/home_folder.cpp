// SPDX-License-Identifier: MIT
#include "home_folder.hpp"

#include <tactus/text/ownership.hpp>

#include <cstdlib>

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

fs::path configurations()
{
#if defined(_WIN32)
    return fromEnvironment ("APPDATA");
#else
    auto home = fromEnvironment ("HOME");
    if (! home.is_absolute()) home.clear();   // it would be in the folder of whatever graph is played
    if (home.empty())
        if (const auto* user = ::getpwuid (::getuid()); user != nullptr && user->pw_dir != nullptr) home = user->pw_dir;
    if (home.empty()) return {};
#if defined(__APPLE__)
    return home / "Library";
#else
    return home / ".config";
#endif
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
