// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/catalogue.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tactus::host
{

/// What a preset says of itself.
struct Preset
{
    std::filesystem::path file;
    std::string name, about;
    std::vector<std::string> tags;
    std::set<std::string> types;             ///< of the nodes in it
    std::vector<std::string> placeholders;   ///< those types that there are not here
    std::string problem;                     ///< why it cannot be read; else empty
};

/// One of them; its problem says why it cannot be read. [main thread]
Preset presetOf (const std::filesystem::path& file, const Catalogue&);

/// The presets of a folder, by name. Files that are no graphs are left out; graphs that cannot be read say why. [main thread]
std::vector<Preset> presetsIn (const std::filesystem::path& folder, const Catalogue&);

/// Where the presets that come with Tactus are: TACTUS_PRESETS in the environment, or beside the program, built or installed.
/// Empty if nowhere.
std::filesystem::path presetFolder();

/// Where people keep their own: TACTUS_GRAPHS in the environment, or Tactus among their documents. It need not be there.
std::filesystem::path ownFolder();

/// Those that have all words of the query in their name, tags or sentence, and all of the tags.
std::vector<Preset> matching (const std::vector<Preset>&, const std::string& query, const std::set<std::string>& tags = {});

/// The tags there are, those of most presets first.
std::vector<std::pair<std::string, int>> tagsOf (const std::vector<Preset>&);

/// "2 placeholders: foo.bar, foo.baz"; nothing if there are none.
std::string placeholderText (const Preset&);

}   // namespace tactus::host
