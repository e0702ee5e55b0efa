// SPDX-License-Identifier: MIT
#include "edit_checks.hpp"

#include "refusals.hpp"
#include <tactus/graph/graph_parts.hpp>
#include <tactus/text/list_text.hpp>

#include <algorithm>
#include <set>

namespace tactus::graph
{

namespace
{
/// True if two targets of a control have the same path.
bool hasTwice (const Control& control)
{
    std::set<std::string_view> paths;
    return std::ranges::any_of (control.to, [&] (const auto& target) { return ! paths.insert (target.path).second; });
}
}   // namespace

std::optional<Message> problemWith (std::string_view path, const Patch& patch, const std::string& in)
{
    const auto name = std::string (path.substr (0, path.find_first_of ("[/.")));
    if (patch.find (name) != nullptr) return std::nullopt;
    return noNode (in, name);
}

std::optional<Message> problemWith (const Wire& wire, const Patch& patch, const std::string& in)
{
    if (auto wrong = check (wire); ! wrong.empty()) return wrong.front();
    if (auto wrong = problemWith (wire.from.node, patch, in)) return wrong;
    return problemWith (wire.to.node, patch, in);
}

std::optional<Message> problemWith (const Control& control, const Graph& graph)
{
    if (auto wrong = check (control); ! wrong.empty()) return wrong.front();
    for (const auto& target : control.to)
        if (auto wrong =
                problemWith (std::string_view (target.path).substr (std::min (target.path.size(), target.path.find_first_not_of (" \t\r\n"))), graph.root, ""))
            return wrong;
    return std::nullopt;
}

bool anythingTwice (const Graph& graph)
{
    const auto in = [] (const Patch& patch) {
        return std::ranges::any_of (patch.nodes, [] (const Node& n) { return ! n.overrides.empty() && ! checkValue (n.overrides); });
    };
    return std::ranges::any_of (graph.controls, hasTwice) || in (graph.root)
           || std::ranges::any_of (graph.graphs, [&] (const auto& g) { return in (g.second); });
}

bool isUsed (Id id, const Graph& g)
{
    const auto in = [id] (const Patch& patch) {
        return std::ranges::find (patch.wires, id, &Wire::id) != patch.wires.end() || std::ranges::find (patch.nodes, id, &Node::id) != patch.nodes.end();
    };
    return in (g.root) || std::ranges::any_of (g.graphs, [&in] (const auto& named) { return in (named.second); });
}

std::unordered_set<Id> usedIds (const Graph& g)
{
    std::unordered_set<Id> ids;
    const auto add = [&] (const Patch& patch) {
        for (const auto& node : patch.nodes)
            ids.insert (node.id);
        for (const auto& wire : patch.wires)
            ids.insert (wire.id);
    };
    add (g.root);
    for (const auto& [name, patch] : g.graphs)
        add (patch);
    return ids;
}

std::string usersOf (const Graph& graph, const std::string& subgraph)
{
    std::string users;
    const auto search = [&] (const std::string& name, const Patch& patch) {
        if (name == subgraph) return;
        for (const auto& node : patch.nodes)
            if (node.type == "graph:" + subgraph) addToList (users, (name.empty() ? "" : name + "/") + node.name);
    };
    search ("", graph.root);
    for (const auto& [name, patch] : graph.graphs)
        search (name, patch);
    return users;
}

}   // namespace tactus::graph
