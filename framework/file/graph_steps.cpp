// SPDX-License-Identifier: MIT
// The steps that migrate graph files. Parts of a file that do not have the expected shape are left for the reader to report.
#include "migrate.hpp"

namespace tactus
{
namespace
{
Json* objectAt (Json& object, std::string_view key)
{
    if (! object.is_object() || ! object.contains (key)) return nullptr;
    auto& value = object.at (key);
    return value.is_object() ? &value : nullptr;
}

/// Writes a member into an object of a node, such as its params, if the node is of a type and does not have the member.
void say (Json& node, std::string_view type, const char* object, std::string_view key, const Json& value)
{
    if (! node.is_object() || ! node.contains ("type")) return;
    if (const auto& its = node.at ("type"); ! its.is_string() || its.asString() != type) return;

    if (! node.contains (object)) node[object] = Json::object();
    if (auto* members = objectAt (node, object); members && ! members->contains (key)) (*members)[key] = value;
}

void sayDefaults (Json& patch)
{
    if (auto* nodes = objectAt (patch, "nodes"))
        for (auto& [id, node] : nodes->asObject())
        {
            say (node, "friction.elasto_plastic", "params", "load", "passive");
            say (node, "deform.surface", "settings", "crease", 180);
        }
}
}   // namespace

void sayDefaultsOfVersion1 (Json& file)
{
    sayDefaults (file);
    if (auto* graphs = objectAt (file, "graphs"))
        for (auto& [name, patch] : graphs->asObject())
            sayDefaults (patch);
}

}   // namespace tactus
