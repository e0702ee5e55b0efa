// SPDX-License-Identifier: GPL-3.0-or-later
#include "fragment.hpp"

#include <framework/file/graph_file.hpp>
#include <framework/graph/endpoints.hpp>

#include <algorithm>
#include <map>

namespace tactus::host
{

namespace
{
const graph::Patch* patchOf (const graph::Graph& g, const std::string& name) { return name.empty() ? &g.root : g.find (name); }

/// Adds the subgraphs that nodes of a patch are of, and those inside.
void addSubgraphs (const graph::Graph& from, const graph::Patch& patch, graph::Graph& into)
{
    for (const auto& n : patch.nodes)
        if (n.type.starts_with ("graph:"))
        {
            const auto name = n.type.substr (6);
            const auto* inside = from.find (name);
            if (inside == nullptr || into.find (name) != nullptr) continue;
            into.graphs.emplace_back (name, *inside);
            addSubgraphs (from, *inside, into);
        }
}

/// "drag" of "drag_2".
std::string stemOf (const std::string& name)
{
    const auto digits = name.find_last_not_of ("0123456789");
    const bool numbered = digits != std::string::npos && digits + 1 < name.size() && name[digits] == '_' && digits > 0;
    return numbered ? name.substr (0, digits) : name;
}

using Place = std::pair<double, double>;

/// Where a node was put, if it was.
std::optional<Place> placeOf (const graph::Node& node)
{
    const auto ui = node.extra.find ("ui");
    if (ui == node.extra.end() || ! ui->is_object()) return std::nullopt;
    const auto at = ui->find ("at");
    if (at == ui->end() || ! at->is_array() || at->size() != 2 || ! (*at)[0].is_number() || ! (*at)[1].is_number()) return std::nullopt;
    return Place { (*at)[0].get<double>(), (*at)[1].get<double>() };
}

void move (graph::Node& node, double dx, double dy)
{
    if (const auto from = placeOf (node)) node.extra["ui"]["at"] = Json::array ({ from->first + dx, from->second + dy });
}
}   // namespace

std::optional<std::pair<double, double>> cornerOf (const std::string& text)
{
    std::optional<Place> corner;
    for (const auto& node : readGraph (text).graph.root.nodes)
        if (const auto at = placeOf (node)) corner = corner ? Place { std::min (corner->first, at->first), std::min (corner->second, at->second) } : *at;
    return corner;
}

std::string freeName (const graph::Patch& patch, const std::set<std::string>& also_taken, const std::string& wanted)
{
    const auto taken = [&] (const std::string& name)
    { return patch.find (name) != nullptr || also_taken.contains (name); };
    if (! taken (wanted)) return wanted;
    const auto stem = stemOf (wanted);
    for (int i = 2;; ++i)
        if (const auto name = stem + '_' + std::to_string (i); ! taken (name)) return name;
}

std::string copyText (const graph::Graph& g, const std::string& patch_name, const std::set<graph::Id>& ids)
{
    graph::Graph copied;
    const auto* patch = patchOf (g, patch_name);
    if (patch == nullptr) return {};
    std::set<std::string> names;
    for (const auto& n : patch->nodes)
        if (ids.contains (n.id))
        {
            copied.root.nodes.push_back (n);
            names.insert (n.name);
        }
    for (const auto& w : patch->wires)
        if (names.contains (graph::firstNameOf (w.from.node)) && names.contains (graph::firstNameOf (w.to.node))) copied.root.wires.push_back (w);
    addSubgraphs (g, copied.root, copied);
    copied.rate_hz = g.rate_hz;
    return writeGraph (copied);
}

std::variant<graph::Command, Message> paste (const graph::Graph& g, const std::string& patch_name, const std::string& text, double dx, double dy, std::set<graph::Id>& made)
{
    auto read = readGraph (text);
    for (auto& m : read.messages)
        if (m.severity == Message::Severity::error) return std::move (m);
    const auto* patch = patchOf (g, patch_name);
    graph::Batch batch { "paste", {} };
    if (patch == nullptr) return batch;

    for (auto& [name, inside] : read.graph.graphs)
        if (g.find (name) == nullptr) batch.commands.push_back (graph::AddSubgraph { name, inside });
    std::map<std::string, std::string> renamed;
    std::set<std::string> taken;
    for (auto& node : read.graph.root.nodes)
    {
        const auto name = freeName (*patch, taken, node.name);
        taken.insert (name);
        renamed.emplace (node.name, name);
        node.name = name;
        move (node, dx, dy);
        made.insert (node.id);
        batch.commands.push_back (graph::AddNode { patch_name, node });
    }
    const auto rename = [&] (graph::Endpoint& e)
    {
        const auto first = graph::firstNameOf (e.node);
        if (const auto to = renamed.find (first); to != renamed.end()) e.node = to->second + e.node.substr (first.size());
    };
    for (auto& wire : read.graph.root.wires)
    {
        rename (wire.from);
        rename (wire.to);
        batch.commands.push_back (graph::AddWire { patch_name, wire });
    }
    return batch;
}

}   // namespace tactus::host
