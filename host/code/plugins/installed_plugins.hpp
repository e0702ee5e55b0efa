// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/catalogue.hpp>
#include <tactus/plugin/plugin_library.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host
{

inline constexpr const char* plugin_suffix = ".tactus";

/// The folders in which plugins are looked for, in this order: `more` (from --plugins), the folders in TACTUS_PLUGINS, `plugins` in
/// homeFolder(), and lib/tactus/plugins of the installation. Some may not exist. [main thread]
std::vector<std::filesystem::path> pluginFolders (const std::vector<std::string>& more);

/// The folders in which this program looks: those of pluginFolders(), with those given to usePlugins(). [main thread]
std::vector<std::filesystem::path> usedPluginFolders();

/// The folder in which the Quarantine of this user keeps its marks; empty if this user has no folder. [main thread]
std::filesystem::path pluginMarks();

/// Loads all plugins of these folders, within each folder sorted by name. Errors: those of loadPlugins, plugin/quarantined. `marks` is
/// the folder of the Quarantine. [main thread]
LoadedPlugins loadFolders (const std::vector<std::filesystem::path>& folders, const std::filesystem::path& marks);

/// Loads one plugin, with a mark in the Quarantine. Errors as for loadFolders. With `present` empty, its nodes may replace any others. [main thread]
LoadedPlugins loadFile (const std::filesystem::path&, const std::filesystem::path& marks, const Catalogue& present);

/// Loads the installed plugins, and adds their nodes to catalogue(). Returns what went wrong: errors of loadFolders, plugin/no_folder.
/// Call it when the program starts, before anything uses the catalogue. [main thread]
Messages usePlugins (const std::vector<std::string>& more);

/// Loads more plugins while a program runs, and adds their nodes to catalogue(): one file, or all of a folder, whose drivers are found from now on, too.
/// Empty: those that usePlugins ({}) loads; then refusals are warnings, because the program did not ask for these plugins by name. A plugin whose
/// nodes are in the catalogue already is left out. Ids: those of usePlugins(). [main thread, while no other thread uses catalogue()]
Messages loadMore (const std::filesystem::path& file_or_folder);

/// Loads a plugin whose nodes replace those of the same ids, such as a new build of a node. [main thread, while no other thread uses catalogue()]
Messages replaceBy (const std::filesystem::path& plugin);

/// The refused plugins, as text for a terminal: the file, the reason, the remedy. Empty if nothing was.
std::string textOf (const Messages&);

/// The folders that --plugins names on a command line: `--plugins DIR` or `--plugins=DIR`, any number of times. The nodes must be known
/// before the rest of the command line is read.
std::vector<std::string> pluginFoldersIn (int argc, const char* const* argv);

}   // namespace tactus::host
