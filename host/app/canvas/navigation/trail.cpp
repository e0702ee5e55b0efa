// SPDX-License-Identifier: GPL-3.0-or-later
#include "trail.hpp"

#include <tactus/graph/instances.hpp>

#include <algorithm>
#include <set>

namespace tactus::host
{

namespace
{
bool leadsTo (const graph::Node& node, const std::string& subgraph) { return node.type == "graph:" + subgraph; }

/// The subgraph nodes on the path to a patch. Empty if the patch cannot be reached from the root.
std::optional<Trail::Entries> entriesTo (const graph::Graph& g, const std::string& patch)
{
    std::vector<Trail::Entries> open { {} };
    std::set<std::string> seen;
    for (std::size_t i = 0; i < open.size(); ++i)
    {
        const auto path = open[i];
        const auto here = path.empty() ? std::string() : path.back().second;
        if (here == patch) return path;
        const auto* in = findPatch (g, here);
        if (in == nullptr || ! seen.insert (here).second) continue;
        for (const auto& n : in->nodes)
            if (n.type.starts_with ("graph:"))
            {
                open.push_back (path);
                open.back().emplace_back (n.name, n.type.substr (6));
            }
    }
    return std::nullopt;
}
}   // namespace

void Trail::follow()
{
    const auto& g = document.graph();
    const auto* in = &g.root;
    for (std::size_t i = 0; i < entered.size(); ++i)
    {
        auto& [name, subgraph] = entered[i];
        const auto* node = in->find (name);
        if (node != nullptr && node->type.starts_with ("graph:") && g.find (subgraph) == nullptr) subgraph = node->type.substr (6);
        if (node == nullptr || ! leadsTo (*node, subgraph))
        {
            const auto other = std::ranges::find_if (in->nodes, [&to = subgraph] (const graph::Node& n) { return leadsTo (n, to); });
            if (other == in->nodes.end()) return entered.resize (i);
            name = other->name;
        }
        in = g.find (subgraph);
        if (in == nullptr) return entered.resize (i);
    }
}

std::string Trail::address (const std::string& port) const
{
    std::string path, names;
    const auto* in = &document.graph().root;
    for (const auto& [name, subgraph] : entered)
    {
        const auto* node = in == nullptr ? nullptr : in->find (name);
        path += name;
        names += name + '/';
        if (const auto chosen = node == nullptr ? std::nullopt : instanceOf (*node, names)) path += '[' + std::to_string (chosen->number) + ']';
        path += '/';
        in = document.graph().find (subgraph);
    }
    return path + port;
}

std::optional<Trail::Instance> Trail::instanceOf (const graph::Node& node, const std::string& names) const
{
    const auto count = graph::countOf (node);
    if (! count || *count < 1) return {};
    const auto chosen = chosen_instances.find (names);
    return Instance { chosen == chosen_instances.end() ? 0 : std::clamp (chosen->second, 0, *count - 1), *count };
}

std::optional<Trail::Instance> Trail::instance() const
{
    std::string names;
    const auto* in = &document.graph().root;
    const graph::Node* node = nullptr;
    for (const auto& [name, subgraph] : entered)
    {
        node = in == nullptr ? nullptr : in->find (name);
        names += name + '/';
        in = document.graph().find (subgraph);
    }
    return node == nullptr ? std::nullopt : instanceOf (*node, names);
}

SeenPatch Trail::seen() const
{
    SeenPatch now (patch());
    for (const auto& [name, subgraph] : entered)
        now.path += name + '/';
    return now;
}

bool Trail::goTo (const std::string& wanted)
{
    auto path = entriesTo (document.graph(), wanted);
    if (path) entered = *std::move (path);
    return path.has_value();
}

}   // namespace tactus::host
