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

void sayLoad (Json& node)
{
    if (! node.is_object() || ! node.contains ("type")) return;
    if (const auto& type = node.at ("type"); ! type.is_string() || type.asString() != "friction.elasto_plastic") return;

    if (! node.contains ("params")) node["params"] = Json::object();
    if (auto* params = objectAt (node, "params"); params && ! params->contains ("load")) (*params)["load"] = "passive";
}

void sayLoads (Json& patch)
{
    if (auto* nodes = objectAt (patch, "nodes"))
        for (auto& [id, node] : nodes->asObject())
            sayLoad (node);
}
}   // namespace

void sayLoadOfFriction (Json& file)
{
    sayLoads (file);
    if (auto* graphs = objectAt (file, "graphs"))
        for (auto& [name, patch] : graphs->asObject())
            sayLoads (patch);
}

}   // namespace tactus
