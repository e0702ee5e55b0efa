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

/// The plugins that the nodes of the catalogue come from.
std::vector<fs::path> loadedFiles()
{
    std::vector<fs::path> files;
    std::error_code unseen;
    for (const auto& type : catalogue())
        if (! type.origin.empty()) files.push_back (fs::weakly_canonical (type.origin, unseen));
    return files;
}

/// The folders given to usePlugins() and loadMore().
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

LoadedPlugins loadFile (const fs::path& file, const fs::path& marks, const Catalogue& present)
{
    const Quarantine quarantine { marks };
    if (quarantine.holds (file)) return { {}, { quarantine.refusal (file) } };
    const Quarantine::LoadingMark loading { quarantine, file };
    return loadPlugins ({ file }, present);
}

LoadedPlugins loadFolders (const std::vector<fs::path>& folders, const fs::path& marks)
{
    LoadedPlugins all;
    std::vector<fs::path> seen = loadedFiles();
    for (const auto& folder : folders)
        for (const auto& file : pluginsIn (folder))
        {
            std::error_code unseen;
            const auto whole = fs::weakly_canonical (file, unseen);
            if (std::ranges::find (seen, whole) != seen.end()) continue;   // loaded already, or the same folder is named twice
            seen.push_back (whole);
            auto loaded = loadFile (file, marks, catalogue().with (all.types));
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

Messages loadMore (const fs::path& path)
{
    std::error_code unseen;
    LoadedPlugins loaded;
    if (path.empty())
    {
        loaded = loadFolders (usedPluginFolders(), pluginMarks());
        if (auto trouble = homeTrouble()) loaded.messages.push_back (std::move (*trouble));
        for (auto& m : loaded.messages)
            m.severity = Message::Severity::warning;
    }
    else if (fs::is_directory (path, unseen))
    {
        loaded = loadFolders ({ path }, pluginMarks());
        if (! hasPlugins (path))
            loaded.messages.push_back (Message::warning ("plugin/none", path.string(), "the folder has no plugins",
                                                         "give the folder that contains the plugins themselves, which end in .tactus or .tactus-device"));
        const auto whole = fs::weakly_canonical (path, unseen).string();
        if (std::ranges::find (givenFolders(), whole) == givenFolders().end()) givenFolders().push_back (whole);
    }
    else if (! fs::exists (path, unseen))
        return { Message::error ("plugin/no_folder", path.string(), "there is no such file or folder", "give a plugin, or a folder that contains plugins") };
    else if (const auto files = loadedFiles(); std::ranges::find (files, fs::weakly_canonical (path, unseen)) == files.end())
        loaded = loadFile (path, pluginMarks(), catalogue());
    if (! loaded.types.empty()) extendCatalogue (std::move (loaded.types));
    return std::move (loaded.messages);
}

Messages replaceBy (const fs::path& plugin)
{
    auto loaded = loadFile (plugin, pluginMarks(), {});
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
