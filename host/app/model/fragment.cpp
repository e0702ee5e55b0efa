// SPDX-License-Identifier: GPL-3.0-or-later
#include "fragment.hpp"
#include "param_value.hpp"
#include "patch.hpp"

#include <host/app/text/filled.hpp>

#include <tactus/file/graph_file.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/run/device/make_device.hpp>
#include <tactus/text/budget.hpp>

#include <algorithm>
#include <map>

namespace tactus::host
{

namespace
{
/// Adds the subgraphs that a patch uses, directly and through others.
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

/// Strips the number: "drag_2" becomes "drag".
std::string stemOf (const std::string& name)
{
    const auto digits = name.find_last_not_of ("0123456789");
    const bool numbered = digits != std::string::npos && digits + 1 < name.size() && name[digits] == '_' && digits > 0;
    return numbered ? name.substr (0, digits) : name;
}

}   // namespace

std::optional<juce::Point<double>> cornerOf (const graph::Patch& patch)
{
    std::optional<juce::Point<double>> corner;
    for (const auto& node : patch.nodes)
        if (const auto at = positionOf (node)) corner = corner ? juce::Point<double> { std::min (corner->x, at->x), std::min (corner->y, at->y) } : *at;
    return corner;
}

std::string usualName (const std::string& type)
{
    if (type == "device.position") return "hand";   // as in the presets
    if (type == "device.force") return "motor";
    const auto cut = type.find_last_of (".:");
    return type.substr (cut == std::string::npos ? 0 : cut + 1);
}

Json newTool()
{
    auto tool = defaultDevice();
    tool["guard"] = Json::parse (R"({ "max_force": "6 N", "max_speed": "2 m/s", "max_impulse": "30 N*s", "impulse_window": "10 s",
        "max_energy": "120 mJ", "energy_window": "1 s" })");
    return tool;
}

std::string asNodeName (const juce::String& typed) { return typed.trim().toLowerCase().replaceCharacters (" -", "__").toStdString(); }

std::string freeName (const graph::Patch& patch, const std::set<std::string>& also_taken, const std::string& wanted)
{
    const auto taken = [&] (const std::string& name) { return patch.find (name) != nullptr || also_taken.contains (name); };
    if (! taken (wanted)) return wanted;
    const auto stem = stemOf (wanted);
    for (int i = 2;; ++i)
        if (const auto name = stem + '_' + std::to_string (i); ! taken (name)) return name;
}

graph::Graph fragmentOf (const graph::Graph& g, const std::string& patch_name, const std::set<graph::Id>& ids)
{
    graph::Graph copied;
    const auto* patch = findPatch (g, patch_name);
    if (patch == nullptr) return copied;
    copied.name = g.name;
    copied.folder = g.folder;
    copied.files = g.files;
    copied.rate_hz = g.rate_hz;
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
    if (! patch_name.empty()) return copied;   // roles and controls are those of the top
    std::set<std::string> roles;
    for (const auto& n : copied.root.nodes)
        roles.insert (n.role);
    for (const auto& [role, device] : g.devices)
        if (roles.contains (role) || ! copied.graphs.empty()) copied.devices.emplace_back (role, device);   // a subgraph may have roles inside
    for (auto c : g.controls)
    {
        std::erase_if (c.to, [&] (const auto& t) { return ! names.contains (graph::firstNameOf (t.path.substr (0, t.path.find ('.')))); });
        if (! c.to.empty()) copied.controls.push_back (std::move (c));
    }
    return copied;
}

std::string copyText (const graph::Graph& g, const std::string& patch, const std::set<graph::Id>& ids) { return writeGraph (fragmentOf (g, patch, ids)); }

Result<graph::Graph> readCopied (const std::string& text)
{
    if (static_cast<double> (text.size()) > budgets().file)
        return Message::error ("file/too_large", {}, TRANS ("the text is larger than a graph file may be").toStdString());
    const auto none = Message::error ("file/no_nodes", {}, TRANS ("the clipboard has no nodes").toStdString());
    if (text.empty()) return none;
    auto read = readGraph (text);
    for (auto& m : read.messages)
        if (m.severity == Message::Severity::error) return std::move (m);
    if (read.graph.root.nodes.empty()) return none;
    return std::move (read.graph);
}

void renewIds (graph::Patch& patch)
{
    for (auto& n : patch.nodes)
    {
        n.id = graph::newId();
        n.origin.clear();
    }
    for (auto& w : patch.wires)
    {
        w.id = graph::newId();
        w.origin.clear();
    }
}

namespace
{
std::string contentOf (const graph::Patch& patch)
{
    graph::Graph g;
    g.graphs.emplace_back ("a", patch);
    return writeGraph (g);
}

/// Gives the subgraphs whose names are taken by others new names.
void renameTaken (const graph::Graph& g, graph::Graph& copied)
{
    std::set<std::string> taken;
    for (const auto& [name, patch] : g.graphs)
        taken.insert (name);
    for (const auto& [name, patch] : copied.graphs)
        taken.insert (name);
    std::map<std::string, std::string> renamed;
    for (auto& [name, patch] : copied.graphs)
    {
        const auto* known = g.find (name);
        if (known == nullptr || contentOf (*known) == contentOf (patch)) continue;
        const auto to = freeName ({}, taken, name);
        taken.insert (to);
        renamed.emplace (name, to);
        name = to;
    }
    const auto adapt = [&] (graph::Patch& patch) {
        for (auto& n : patch.nodes)
            if (n.type.starts_with ("graph:"))
                if (const auto to = renamed.find (n.type.substr (6)); to != renamed.end()) n.type = "graph:" + to->second;
    };
    adapt (copied.root);
    for (auto& [name, patch] : copied.graphs)
        adapt (patch);
}
}   // namespace

Result<graph::Command> paste (const graph::Graph& g, const std::string& patch_name, graph::Graph copied, juce::Point<double> offset,
                              std::set<graph::Id>& made)
{
    const auto* patch = findPatch (g, patch_name);
    graph::Batch batch { NEEDS_TRANS ("paste"), {} };
    if (patch == nullptr) return graph::Command (std::move (batch));

    renewIds (copied.root);
    for (auto& [name, inside] : copied.graphs)
        renewIds (inside);
    renameTaken (g, copied);
    for (auto& [name, inside] : copied.graphs)
        if (g.find (name) == nullptr) batch.commands.push_back (graph::AddSubgraph { name, inside });
    for (const auto& [role, device] : copied.devices)
        if (patch_name.empty() && g.device (role) == nullptr) batch.commands.push_back (graph::SetDevice { role, device });
    std::set<std::pair<double, double>> places;
    for (const auto& n : patch->nodes)
        if (const auto at = positionOf (n)) places.emplace (at->x, at->y);
    const auto covers = [&] (const graph::Node& node) {
        const auto at = positionOf (node);
        return at && places.contains ({ at->x + offset.x, at->y + offset.y });
    };
    // The number of steps is limited, because a copied position may be so large that a step does not change it.
    for (std::size_t i = 0; i < places.size() && std::ranges::any_of (copied.root.nodes, covers); ++i)
        offset += { 32.0, 32.0 };
    std::map<std::string, std::string> renamed;
    std::set<std::string> taken;
    for (auto& node : copied.root.nodes)
    {
        const auto name = freeName (*patch, taken, node.name);
        taken.insert (name);
        renamed.emplace (node.name, name);
        node.name = name;
        if (const auto at = positionOf (node)) node.extra["ui"]["at"] = Json::array ({ at->x + offset.x, at->y + offset.y });
        made.insert (node.id);
        batch.commands.push_back (graph::AddNode { patch_name, node });
    }
    const auto rename = [&] (graph::Endpoint& e) {
        const auto first = graph::firstNameOf (e.node);
        if (const auto to = renamed.find (first); to != renamed.end()) e.node = to->second + e.node.substr (first.size());
    };
    for (auto& wire : copied.root.wires)
    {
        rename (wire.from);
        rename (wire.to);
        auto bends = bendsOf (wire);
        for (auto& b : bends)
            b += offset;
        batch.commands.push_back (graph::AddWire { patch_name, bends.empty() ? wire : withBends (wire, bends) });
    }
    return graph::Command (std::move (batch));
}

graph::Command toggleExposed (const graph::Graph& g, const std::string& subgraph, const std::string& node, const FacePort& port)
{
    const auto* patch = findPatch (g, subgraph);
    auto to = patch == nullptr ? graph::Expose {} : patch->expose;
    auto& sources = port.role == Role::input ? to.inputs : to.params;
    auto& ports = port.role == Role::output ? to.outputs : sources;
    const auto entry = entryOf (port.id);
    const graph::Endpoint end { node, baseOf (port.id), entry ? static_cast<int> (*entry) : -1 };
    const auto shown = std::ranges::find (ports, end, &std::pair<std::string, graph::Endpoint>::second);
    if (shown != ports.end())
    {
        ports.erase (shown);
        return graph::Batch { NEEDS_TRANS ("hide port"), { graph::ChangeExpose { subgraph, std::move (to) } } };
    }
    std::set<std::string> taken;
    for (const auto* all : { &to.inputs, &to.params, &to.outputs })
        for (const auto& [name, where] : *all)
            taken.insert (name);
    ports.emplace_back (freeName ({}, taken, end.port), end);
    return graph::Batch { NEEDS_TRANS ("expose port"), { graph::ChangeExpose { subgraph, std::move (to) } } };
}

std::optional<NodeParam> paramThrough (const graph::Graph& g, const std::string& patch, const std::string& path, graph::Batch& batch)
{
    constexpr std::string_view subgraph = "graph:";
    const auto slash = path.find ('/');
    const auto dot = path.find ('.', slash == path.npos ? 0 : slash);
    const auto* in = findPatch (g, patch);
    const auto* node = in == nullptr || dot == path.npos ? nullptr : in->find (path.substr (0, std::min (slash, dot)));
    if (node == nullptr) return std::nullopt;
    if (slash == path.npos) return NodeParam { node->name, path.substr (dot + 1) };
    if (! node->type.starts_with (subgraph)) return std::nullopt;
    const auto inside = node->type.substr (subgraph.size());
    const auto inner = paramThrough (g, inside, path.substr (slash + 1), batch);
    if (! inner) return std::nullopt;
    FacePort port;
    port.role = Role::param;
    port.id = inner->param;
    const auto exposedAs = [&] (const graph::Expose& all) -> std::optional<NodeParam> {
        const auto entry = entryOf (port.id);
        const graph::Endpoint end { inner->node, baseOf (port.id), entry ? static_cast<int> (*entry) : -1 };
        const auto at = std::ranges::find (all.params, end, &std::pair<std::string, graph::Endpoint>::second);
        return at == all.params.end() ? std::nullopt : std::optional (NodeParam { node->name, at->first });
    };
    if (auto known = exposedAs (findPatch (g, inside)->expose)) return known;
    const auto expose = std::get<graph::Batch> (toggleExposed (g, inside, inner->node, port).edit).commands.front();
    batch.commands.push_back (expose);
    return exposedAs (std::get<graph::ChangeExpose> (expose.edit).to);
}

}   // namespace tactus::host
