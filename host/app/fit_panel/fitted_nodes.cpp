// SPDX-License-Identifier: GPL-3.0-or-later
#include "fitted_nodes.hpp"

#include <host/app/model/fragment.hpp>
#include <host/app/model/obvious_wires.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoints.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
using Names = std::vector<std::pair<std::string, std::string>>;   // in the graph of the fit, and in the patch

const std::string* newName (const Names& names, const std::string& old)
{
    const auto at = std::ranges::find (names, graph::firstNameOf (old), &Names::value_type::first);
    return at == names.end() ? nullptr : &at->second;
}

/// The node of the patch that a hand or a motor of the fit stands for. Null for other nodes, and if the patch has none.
const graph::Node* counterpart (const graph::Graph& fit, const std::string& name, const graph::Patch& patch)
{
    const auto* node = fit.root.find (name);
    if (node == nullptr || ! node->type.starts_with ("device.")) return nullptr;
    const auto same = std::ranges::find (patch.nodes, node->type, &graph::Node::type);
    return same == patch.nodes.end() ? nullptr : &*same;
}

/// The wires of the fit between its nodes and its devices.
graph::Batch deviceWires (const graph::Graph& fit, const Names& names, const graph::Patch& patch, const std::string& in)
{
    graph::Batch all { NEEDS_TRANS ("connect"), {} };
    for (auto wire : fit.root.wires)
    {
        const auto *from = newName (names, wire.from.node), *to = newName (names, wire.to.node);
        if ((from != nullptr) == (to != nullptr)) continue;   // both: pasted with the nodes
        const auto* device = counterpart (fit, from != nullptr ? wire.to.node : wire.from.node, patch);
        if (device == nullptr) continue;
        wire.id = graph::newId();
        wire.from.node = from != nullptr ? *from : device->name;
        wire.to.node = to != nullptr ? *to : device->name;
        all.commands.push_back (graph::AddWire { in, std::move (wire) });
    }
    return all;
}
}   // namespace

Result<graph::Command> addFitted (const graph::Graph& g, const std::string& in, const FittedGraph& fit, const Catalogue& types, std::set<graph::Id>& made)
{
    auto source = fit.preset;
    std::set<graph::Id> ids;
    Names names;
    for (auto& node : source.root.nodes)
        if (std::ranges::count (fit.nodes, node.name) > 0)
        {
            node.extra.erase ("ui");
            ids.insert (node.id);
            names.emplace_back (node.name, std::string());
        }
    auto pasted = paste (g, in, fragmentOf (source, {}, ids), {}, made);
    if (! pasted) return pasted;
    std::size_t number = 0;   // the copies are in the order of the originals
    for (const auto& c : std::get<graph::Batch> (pasted->edit).commands)
        if (const auto* added = std::get_if<graph::AddNode> (&c.edit)) names[number++].second = added->node.name;

    graph::Batch all { NEEDS_TRANS ("add fit"), {} };
    auto with = g;
    const auto add = [&] (graph::Command c) {
        if (graph::apply (with, c)) all.commands.push_back (std::move (c));
    };
    add (*std::move (pasted));
    if (const auto* patch = findPatch (with, in)) add (deviceWires (source, names, *patch, in));
    for (const auto& [old, name] : names)
        add (wiring::obviousWires (with, in, name, types));
    return graph::Command (std::move (all));
}

}   // namespace tactus::host
