// SPDX-License-Identifier: MIT
#include "plugin_library.hpp"
#include "answer.hpp"
#include "device_form.hpp"
#include "hook_turn.hpp"
#include "known.hpp"
#include "plugin_node.hpp"

#include <tactus/text/quick_hash.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>

namespace tactus
{

namespace
{
const tactus_plugin_host& host()
{
    static const std::string form = plugin::formOfDeviceState();
    static const tactus_plugin_device_state devices { sizeof devices, form.c_str() };
    static const tactus_plugin_host one { sizeof one, TACTUS_PLUGIN_ABI, "Tactus", "", [] (const char* id) noexcept -> const void* {
                                             return std::strcmp (id, TACTUS_PLUGIN_DEVICE_STATE) == 0 ? &devices : nullptr;
                                         } };
    return one;
}

/// A hash of the file that has been loaded.
std::uint32_t buildOf (const std::filesystem::path& file)
{
    std::ostringstream bytes;
    bytes << std::ifstream (file, std::ios::binary).rdbuf();
    return quickHash (bytes.view());
}

std::string rebuild() { return "build the plugin again, with the <tactus/tactus_plugin.h> of this version"; }
}   // namespace

Result<std::shared_ptr<PluginLibrary>> PluginLibrary::load (const std::filesystem::path& file)
{
    auto object = SharedObject::load (file);
    if (! object) return std::move (object).error();
    const std::shared_ptr<PluginLibrary> made (new PluginLibrary (file, std::move (*object)));
    if (auto begun = made->begin(); ! begun) return std::move (begun).error();
    return made;
}

Result<> PluginLibrary::begin()
{
    const auto refuse = [this] (const char* id, const std::string& why) { return Message::error (id, from.string(), why, rebuild()); };
    const auto* given = static_cast<const tactus_plugin*> (object->find ("tactus_plugin_entry"));
    if (given == nullptr) return refuse ("plugin/no_entry", "the file is not a Tactus plugin: it does not export `tactus_plugin_entry`");
    if (given->size < offsetof (tactus_plugin, abi) + sizeof given->abi) return refuse ("plugin/wrong_size", "`tactus_plugin_entry` has the wrong size");
    if (given->abi != TACTUS_PLUGIN_ABI)
        return refuse ("plugin/wrong_abi", "the plugin is for version " + std::to_string (given->abi) + " of the plugin interface, and this Tactus has version "
                                               + std::to_string (TACTUS_PLUGIN_ABI));
    if (! plugin::isWhole (given))
        return refuse ("plugin/wrong_size", "`tactus_plugin_entry` is too small for its version");
    plugin::copyKnown (entry, given);
    if (entry.init == nullptr || entry.deinit == nullptr || entry.get_node_count == nullptr || entry.get_node == nullptr)
        return refuse ("plugin/wrong_size", "`tactus_plugin_entry` lacks init, deinit, get_node_count or get_node");

    plugin::Answer why;
    has_begun = true;
    const auto turn = plugin::hookTurn();
    if (entry.init (&host(), why.report()) == TACTUS_PLUGIN_OK) return {};
    return Message::error ("plugin/init_failed", from.string(), "the plugin refuses to start: " + quote (why.text()), "ask its author, or remove it");
}

PluginLibrary::~PluginLibrary()
{
    if (! has_begun) return;
    const auto turn = plugin::hookTurn();
    entry.deinit();
}

std::vector<NodeType> PluginLibrary::types (Messages& messages, const std::string& state_layout)
{
    std::vector<NodeType> all;
    const auto build = buildOf (from);
    const auto turn = plugin::hookTurn();
    for (std::size_t i = 0; i < entry.get_node_count(); ++i)
    {
        auto type = plugin::readNode (entry.get_node (i), from.string(), shared_from_this(), build, state_layout);
        if (type)
            all.push_back (std::move (*type));
        else
            messages.push_back (std::move (type).error());
    }
    return all;
}

LoadedPlugins loadPlugins (const std::vector<std::filesystem::path>& files, const Catalogue& present)
{
    LoadedPlugins all;
    for (const auto& file : files)
    {
        auto library = PluginLibrary::load (file);
        if (! library)
        {
            all.messages.push_back (std::move (library).error());
            continue;
        }
        for (auto& type : (*library)->types (all.messages))
        {
            const auto* other = present.find (type.info.id);
            const auto before = std::ranges::find (all.types, type.info.id, [] (const NodeType& t) { return t.info.id; });
            if (before != all.types.end()) other = &*before;
            if (other == nullptr)
                all.types.push_back (std::move (type));
            else
                all.messages.push_back (Message::error ("plugin/two_ids", file.string(),
                                                        "the node " + quote (type.info.id) + " exists already, in "
                                                            + (other->origin.empty() ? std::string ("Tactus itself") : quotePath (other->origin)),
                                                        "remove one of the two, or ask the author of one for a different id"));
        }
    }
    return all;
}

}   // namespace tactus
