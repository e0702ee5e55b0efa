// SPDX-License-Identifier: MIT
#include "support/tested_types.hpp"
#include "load.hpp"

#include <algorithm>
#include <cstdlib>

namespace
{
/// The plugins of a folder, sorted by name.
std::vector<std::filesystem::path> pluginsIn (const std::filesystem::path& folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator (folder))
        if (entry.path().extension() == ".tactus") files.push_back (entry.path());
    std::ranges::sort (files);
    return files;
}
}   // namespace

/// The nodes of the plugin five_nodes, so that every_node_test.cpp examines them as it examines those that are compiled in.
/// TACTUS_TESTED_PLUGINS names a folder with other plugins (tests/plugins/all_nodes.sh).
const tactus::Catalogue& tactus::test::testedTypes()
{
    static const char* const folder = std::getenv ("TACTUS_TESTED_PLUGINS");
    static const Catalogue types { folder == nullptr ? load ("five_nodes").types : loadPlugins (pluginsIn (folder), {}).types };
    return types;
}
