// SPDX-License-Identifier: MIT
#include "included_guards.hpp"

#include <tactus/graph/instances.hpp>
#include <tactus/plan/flat/roles.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace tactus
{

namespace
{
const Json* guardOf (const Json& description)
{
    return description.is_object() && description.contains ("guard") ? &description.at ("guard") : nullptr;
}

/// True if a file that the graph includes has a guard. Most graphs include none, and then need no search. A file that is included in several
/// places is looked at once, so the work does not grow with the number of paths to it.
bool includesGuards (const graph::Graph& graph, std::set<const graph::Graph*>& seen)
{
    return std::ranges::any_of (graph.files, [&] (const auto& included) {
        if (! seen.insert (included.second.get()).second) return false;
        const auto hasGuard = [] (const auto& device) { return guardOf (device.second) != nullptr; };
        return std::ranges::any_of (included.second->devices, hasGuard) || includesGuards (*included.second, seen);
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

    std::set<std::pair<const Json*, std::string>> known;

    void take (const graph::Graph& file, const std::string& name, const plan::Roles& roles)
    {
        for (const auto& [role, description] : file.devices)
            if (const auto* guard = guardOf (description))
            {
                const auto outer = roles.find (role);
                const auto& mapped = outer == roles.end() ? role : outer->second;
                if (known.emplace (guard, mapped).second) found.push_back ({ mapped, *guard, name, "/devices/" + role + "/guard" });
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
    std::set<const graph::Graph*> seen;
    if (! includesGuards (graph, seen)) return {};
    Search search;
    search.in (graph, graph.root, {});
    return std::move (search.found);
}

}   // namespace tactus
