// SPDX-License-Identifier: MIT
#pragma once

#include "shared_object.hpp"
#include <tactus/tactus_plugin.h>

#include <tactus/node/catalogue.hpp>
#include <tactus/text/message.hpp>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tactus
{

/// A loaded node plugin. Its types keep it loaded, and so does each of their nodes. [main thread]
class PluginLibrary : public std::enable_shared_from_this<PluginLibrary>
{
public:
    /// Runs code of the plugin: its static initialisers, and `init`. Refuses a file that is not a plugin, or is one for another
    /// version of the interface.
    /// Errors: plugin/cannot_load, plugin/no_entry, plugin/wrong_abi, plugin/wrong_size, plugin/init_failed.
    static Result<std::shared_ptr<PluginLibrary>> load (const std::filesystem::path&);

    ~PluginLibrary();
    PluginLibrary (const PluginLibrary&) = delete;
    PluginLibrary& operator= (const PluginLibrary&) = delete;

    const std::filesystem::path& file() const noexcept { return from; }
    std::string name() const { return entry.name != nullptr ? entry.name : ""; }
    std::string version() const { return entry.version != nullptr ? entry.version : ""; }

    /// Its node types, each checked. Adds an error for each that is refused: plugin/bad_node. If two builds of a plugin are given the
    /// same `state_layout`, and it is not empty, their nodes adopt each other's state: give them the same text only if their nodes are
    /// known to have the same layout in memory.
    std::vector<NodeType> types (Messages&, const std::string& state_layout = {});

private:
    PluginLibrary (std::filesystem::path f, std::unique_ptr<SharedObject> o) : from (std::move (f)), object (std::move (o)) {}
    Result<> begin();

    std::filesystem::path from;
    std::unique_ptr<SharedObject> object;
    tactus_plugin entry {};
    bool has_begun = false;
};

struct LoadedPlugins
{
    std::vector<NodeType> types {};
    Messages messages {};
};

/// Loads plugins. A node whose id is in the catalogue already, or in an earlier plugin of the list, is refused by name
/// (plugin/two_ids); the other nodes of that plugin are used. [main thread]
///
///     auto loaded = loadPlugins (files, catalogue());
///     extendCatalogue (std::move (loaded.types));
LoadedPlugins loadPlugins (const std::vector<std::filesystem::path>& files, const Catalogue& present);

}   // namespace tactus
