// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/base/platform/preset_folder.hpp>
#include <tactus/node/catalogue.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// The metadata of a preset.
struct Preset
{
    std::filesystem::path file;
    std::string name, about;
    std::vector<std::string> tags;
    std::set<std::string> types;             ///< node types that the preset uses
    std::vector<std::string> placeholders;   ///< types missing from the catalogue
    std::string problem;                     ///< why the preset cannot be read; empty if it can
    bool has_subgraphs = false;
};

/// Reads one preset. If that fails, `problem` says why. [main thread]
Preset presetOf (const std::filesystem::path& file, const Catalogue&);

/// Lists the presets of a folder by name. Skips files that are not graphs; damaged graphs are listed with their problem. [main thread]
std::vector<Preset> presetsIn (const std::filesystem::path& folder, const Catalogue&);

/// The folder of the user's own graphs: TACTUS_GRAPHS in the environment, or Tactus in the user's documents. It may not exist yet.
std::filesystem::path ownFolder();

/// The presets that fit the query by their name, tags or description (text/find.hpp), the best first, and have all of the tags.
std::vector<Preset> matching (const std::vector<Preset>&, const std::string& query, const std::set<std::string>& tags = {});

/// All tags with the number of presets that have them, most frequent first.
std::vector<std::pair<std::string, int>> tagsOf (const std::vector<Preset>&);

/// The description of a preset that is dragged from a list, and the file of a dragged preset; empty if something else is dragged.
std::string asDragged (const Preset&);
std::filesystem::path fileOfDragged (const std::string&);

/// "2 placeholders: foo.bar, foo.baz". Empty if there are none.
std::string placeholderText (const Preset&);

}   // namespace tactus::host
