// SPDX-License-Identifier: MIT
#include "installed_plugins.hpp"
#include "quarantine.hpp"

#include <host/base/platform/home_folder.hpp>
#include <host/base/platform/start_program.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <string_view>

namespace tactus::host
{

namespace
{
namespace fs = std::filesystem;

#if defined(_WIN32)
constexpr char between_folders = ';';
#else
constexpr char between_folders = ':';
#endif

std::vector<fs::path> pluginsIn (const fs::path& folder)
{
    std::vector<fs::path> files;
    std::error_code unseen;
    for (const auto& entry : fs::directory_iterator (folder, unseen))
        if (entry.path().extension() == plugin_suffix && entry.is_regular_file (unseen)) files.push_back (entry.path());
    std::ranges::sort (files);
    return files;
}

/// True if a folder has plugins with nodes or with drivers of devices, which end in .tactus-device.
bool hasPlugins (const fs::path& folder)
{
    std::error_code unseen;
    for (const auto& entry : fs::directory_iterator (folder, unseen))
        if (entry.path().extension().string().starts_with (plugin_suffix)) return true;
    return false;
}

/// The folders given to usePlugins().
std::vector<std::string>& givenFolders()
{
    static std::vector<std::string> folders;
    return folders;
}
}   // namespace

std::vector<fs::path> pluginFolders (const std::vector<std::string>& more)
{
    std::vector<fs::path> all (more.begin(), more.end());
    if (const char* told = std::getenv ("TACTUS_PLUGINS"))
    {
        std::istringstream list { std::string (told) };
        for (std::string folder; std::getline (list, folder, between_folders);)
            if (! folder.empty()) all.emplace_back (folder);
    }
    if (const auto home = homeFolder(); ! home.empty()) all.push_back (home / "plugins");
    if (const auto program = programFolder(); ! program.empty()) all.push_back ((program / "../lib/tactus/plugins").lexically_normal());
    return all;
}

std::vector<fs::path> usedPluginFolders() { return pluginFolders (givenFolders()); }

fs::path pluginMarks()
{
    const auto home = homeFolder();
    return home.empty() ? home : home / "plugin-marks";
}

LoadedPlugins loadFolders (const std::vector<fs::path>& folders, const fs::path& marks)
{
    const Quarantine quarantine { marks };
    LoadedPlugins all;
    std::vector<fs::path> seen;
    for (const auto& folder : folders)
        for (const auto& file : pluginsIn (folder))
        {
            std::error_code unseen;
            const auto whole = fs::weakly_canonical (file, unseen);
            if (std::ranges::find (seen, whole) != seen.end()) continue;   // the same folder is named twice
            seen.push_back (whole);
            if (quarantine.holds (file))
            {
                all.messages.push_back (quarantine.refusal (file));
                continue;
            }
            const Quarantine::LoadingMark loading { quarantine, file };
            auto loaded = loadPlugins ({ file }, catalogue().with (all.types));
            std::ranges::move (loaded.types, std::back_inserter (all.types));
            std::ranges::move (loaded.messages, std::back_inserter (all.messages));
        }
    return all;
}

Messages usePlugins (const std::vector<std::string>& more)
{
    givenFolders() = more;
    auto loaded = loadFolders (pluginFolders (more), pluginMarks());
    if (auto trouble = homeTrouble()) loaded.messages.push_back (std::move (*trouble));
    std::error_code unseen;
    for (const auto& folder : more)
        if (! fs::is_directory (folder, unseen))
            loaded.messages.push_back (Message::error ("plugin/no_folder", folder, "--plugins names a folder that does not exist",
                                                       "give the folder that contains the plugins"));
        else if (! hasPlugins (folder))
            loaded.messages.push_back (Message::warning ("plugin/none", folder, "--plugins names a folder without plugins",
                                                         "give the folder that contains the plugins themselves, which end in .tactus or .tactus-device"));
    if (! loaded.types.empty()) extendCatalogue (std::move (loaded.types));
    return std::move (loaded.messages);
}

std::string textOf (const Messages& messages)
{
    std::string text;
    for (const auto& m : messages)
        text += printableName (m.where) + ": warning: " + printable (m.text) + "\n    " + printable (m.remedy) + " [" + m.id + "]\n";
    return text;
}

std::vector<std::string> pluginFoldersIn (int argc, const char* const* argv)
{
    constexpr std::string_view option = "--plugins";
    std::vector<std::string> folders;
    for (int i = 1; i < argc; ++i)
    {
        const std::string_view word = argv[i];
        if (word == option && i + 1 < argc)
            folders.emplace_back (argv[++i]);
        else if (word.starts_with (option) && word.substr (option.size()).starts_with ('='))
            folders.emplace_back (word.substr (option.size() + 1));
    }
    return folders;
}

}   // namespace tactus::host
