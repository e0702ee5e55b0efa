// SPDX-License-Identifier: MIT
#include "included_guards.hpp"

#include <tactus/graph/instances.hpp>
#include <tactus/plan/roles.hpp>

#include <algorithm>

namespace tactus
{

namespace
{
const Json* guardOf (const Json& description)
{
    return description.is_object() && description.contains ("guard") ? &description.at ("guard") : nullptr;
}

/// True if a file that the graph includes has a guard. Most graphs include none, and then need no search.
bool includesGuards (const graph::Graph& graph)
{
    return std::ranges::any_of (graph.files, [] (const auto& included) {
        const auto hasGuard = [] (const auto& device) { return guardOf (device.second) != nullptr; };
        return std::ranges::any_of (included.second->devices, hasGuard) || includesGuards (*included.second);
    });
}

class Search
{
public:
    void in (const graph::Graph& owner, const graph::Patch& patch, const plan::Roles& roles)
    {
        for (const auto& node : patch.nodes)
        {
            const auto name = node.type.substr (node.type.find (':') + 1);
            if (node.type.starts_with ("graph:"))
            {
                if (const auto* inside = owner.find (name)) inEach (node, roles, [&] (const plan::Roles& mapped) { in (owner, *inside, mapped); });
            }
            else if (const auto file = owner.files.find (name); node.type.starts_with ("file:") && file != owner.files.end())
                inEach (node, roles, [&] (const plan::Roles& mapped) {
                    take (*file->second, file->first, mapped);
                    in (*file->second, file->second->root, mapped);
                });
        }
    }

    std::vector<IncludedGuard> found;

private:
    template <typename Act>
    static void inEach (const graph::Node& node, const plan::Roles& roles, Act&& act)
    {
        for (int k = 0, n = std::max (1, graph::countOf (node).value_or (1)); k < n; ++k)
            act (plan::rolesInside (node, roles, k));
    }

    void take (const graph::Graph& file, const std::string& name, const plan::Roles& roles)
    {
        for (const auto& [role, description] : file.devices)
            if (const auto* guard = guardOf (description))
            {
                const auto outer = roles.find (role);
                IncludedGuard one { outer == roles.end() ? role : outer->second, *guard, name, "/devices/" + role + "/guard" };
                if (std::ranges::find (found, one) == found.end()) found.push_back (std::move (one));
            }
    }
};
}   // namespace

Json withoutGuard (Json description)
{
    if (description.is_object()) description.erase ("guard");
    return description;
}

std::vector<IncludedGuard> includedGuards (const graph::Graph& graph)
{
    if (! includesGuards (graph)) return {};
    Search search;
    search.in (graph, graph.root, {});
    return std::move (search.found);
}

}   // namespace tactus
