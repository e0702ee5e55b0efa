// SPDX-License-Identifier: MIT
#include "roles.hpp"

#include <algorithm>

namespace tactus::plan
{

namespace
{
/// True if a device node of the patch has the role, or if a device node in a nested subgraph may have it.
bool hasRole (const graph::Patch& patch, const std::string& role)
{
    return std::ranges::any_of (patch.nodes, [&] (const graph::Node& n) { return n.role == role || n.type.find (':') != std::string::npos; });
}
}   // namespace

void readRole (const graph::Node& node, Origin here, const Roles& roles, FlatNode& made, Flat& flat)
{
    if (made.type->bind != nullptr && node.role.empty())
        flat.error ("node/no_role", here, "'" + made.path + "' (" + node.type + ") has no role, so its device is unknown",
                    "give it a role, for example \"role\": \"stylus\"");
    if (made.type->bind == nullptr && ! node.role.empty())
        flat.warn ("node/needless_role", flat.at (here, "role"), "'" + made.path + "' (" + node.type + ") is not a device node, so its role has no effect",
                   "remove the role");
    if (made.type->bind == nullptr && node.role.empty()) return;
    const auto outer = roles.find (node.role);
    made.role = outer == roles.end() ? node.role : outer->second;
}

void checkRoles (const graph::Node& node, const std::string& path, Origin here, const graph::Patch& patch, int count, Flat& flat)
{
    const auto most = static_cast<double> (node.roles.items().size() * (patch.nodes.size() + 1));
    if (! flat.spend (most, 0.0, here)) return;
    for (const auto& [inner, outer] : node.roles.items())
    {
        const auto origin = flat.at (here, "roles", inner);
        if (! hasRole (patch, inner))
            flat.warn ("node/unknown_role", origin, "nothing in '" + path + "' has the role '" + inner + "'",
                       "name a role of the subgraph's device nodes");
        const bool is_list = outer.is_array() && std::ranges::all_of (outer, &Json::is_string);
        if (! is_list && ! outer.is_string())
            flat.error ("node/bad_roles", origin,
                        "role '" + inner + "' of '" + path + "' must be the name of a role, or a list of names",
                        "write { \"" + inner + "\": \"stylus\" }");
        else if (is_list && outer.size() != at (count))
            flat.error ("node/bad_roles", origin,
                        "role '" + inner + "' of '" + path + "' is given " + std::to_string (outer.size()) + " names, but there "
                            + (count == 1 ? "is 1 instance" : "are " + std::to_string (count) + " instances"),
                        "give a list with one name for each instance, or a single name for all");
    }
}

Roles rolesInside (const graph::Node& node, const Roles& roles, int instance)
{
    Roles mapped;
    const auto k = at (instance);
    for (const auto& [inner, outer] : node.roles.items())
    {
        const auto& name = outer.is_array() && k < outer.size() ? outer[k] : outer;
        if (! name.is_string()) continue;
        const auto through = roles.find (name.asString());
        mapped[inner] = through == roles.end() ? name.asString() : through->second;
    }
    for (const auto& [inner, outer] : roles)
        mapped.try_emplace (inner, outer);
    return mapped;
}

}   // namespace tactus::plan
