// SPDX-License-Identifier: GPL-3.0-or-later
#include "parts.hpp"
#include "sinks.hpp"

#include <host/app/layers/mixer.hpp>
#include <host/app/model/face.hpp>

#include <tactus/graph/edit.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/inside.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace tactus::host::compose
{

namespace
{
using Kinds = unsigned;
constexpr Kinds wall = 1, friction = 2, texture = 4, vibration = 8, other = 16;

Kinds bits (const Parts& p)
{
    return (p.walls ? wall : 0u) | (p.friction ? friction : 0u) | (p.textures ? texture : 0u) | (p.vibrations ? vibration : 0u) | (p.others ? other : 0u);
}

std::string familyOf (const std::string& type) { return type.substr (0, type.find_first_of (".:")); }

/// True for a node that passes on what goes into it: a sum, a product, a filter, a hold, a limit.
bool passesOn (const std::string& type)
{
    static const std::set<std::string> families { "vector", "signal", "layer", "hold", "safety", "filter" };
    return families.contains (familyOf (type));
}

bool multiplies (const std::string& type) { return type == "signal.multiply" || type == "vector.scale" || type == "vector.dot" || type == "vector.cross"; }

/// The kind of a node that makes a force; 0 for nodes that only measure.
Kinds kindOf (const std::string& type)
{
    const auto family = familyOf (type);
    if (family == "deform" || family == "coupling") return wall;
    if (family == "friction") return friction;
    if (family == "texture") return texture;
    if (family == "vibration" || family == "shock") return vibration;
    return family == "device" || family == "contact" || family == "motion" ? 0u : other;
}

class Sorter
{
public:
    Sorter (graph::Graph& graph, const Catalogue& c) : g (graph), catalogue (c) {}

    /// The kinds of effect in what leaves a node.
    Kinds of (const graph::Patch& patch, const graph::Endpoint& from, int depth = 0) const
    {
        const auto* n = patch.find (graph::firstNameOf (from.node));
        if (n == nullptr || n->bypass || depth > deepest) return 0;
        if (n->isSubgraph())
        {
            const auto inside = graph::insideOf (g, *n);
            const auto* e = exposed (inside.patch, from.port);
            return e == nullptr || inside.owner != &g ? 0 : of (*inside.patch, *e, depth + 1);
        }
        if (n->type == "signal.clip" || n->type == "signal.noise" || n->type == "signal.lfo") return vibration;
        if (passesOn (n->type))
        {
            Kinds all = 0;
            for (const auto& w : patch.wires)
                if (graph::firstNameOf (w.to.node) == n->name) all |= of (patch, w.from, depth + 1);
            return all;
        }
        const auto face = faceOf (g, patch, *n, catalogue);
        const auto* port = face.startOf (from);
        const bool is_effort = port != nullptr && (port->quantity() == Quantity::force || port->quantity() == Quantity::torque);
        return is_effort ? kindOf (n->type) : 0;
    }

    /// Unplugs the effects that are not kept from a node, or from one of its ports.
    void unplug (graph::Patch& patch, const std::string& node, std::string_view port, Kinds kept, int depth = 0)
    {
        std::vector<graph::Endpoint> mixed;
        std::vector<graph::Id> removed;
        for (const auto& w : patch.wires)
        {
            if (graph::firstNameOf (w.to.node) != node || (! port.empty() && w.to.port != port)) continue;
            const auto kinds = of (patch, w.from);
            if ((kinds & ~kept) == 0) continue;
            if ((kinds & kept) == 0)
                removed.push_back (w.id);
            else
                mixed.push_back (w.from);
        }
        std::erase_if (patch.wires, [&] (const graph::Wire& w) { return std::ranges::count (removed, w.id) > 0; });
        for (const auto& from : mixed)
            enter (patch, from, kept, depth);
    }

private:
    static constexpr int deepest = 64;   // nodes in a row; a loop with a delay has no end

    graph::Graph& g;
    const Catalogue& catalogue;

    static const graph::Endpoint* exposed (const graph::Patch* patch, const std::string& port)
    {
        if (patch == nullptr) return nullptr;
        const auto at = std::ranges::find (patch->expose.outputs, port, &std::pair<std::string, graph::Endpoint>::first);
        return at == patch->expose.outputs.end() ? nullptr : &at->second;
    }

    /// Unplugs from the node behind a signal in which kept effects are mixed with others.
    void enter (graph::Patch& patch, const graph::Endpoint& from, Kinds kept, int depth)
    {
        const auto* n = patch.find (graph::firstNameOf (from.node));
        if (n == nullptr || depth > deepest) return;
        if (n->type.starts_with ("graph:"))
        {
            auto inner = std::ranges::find (g.graphs, n->type.substr (6), &std::pair<std::string, graph::Patch>::first);
            if (inner == g.graphs.end()) return;
            if (const auto* e = exposed (&inner->second, from.port)) enter (inner->second, graph::Endpoint (*e), kept, depth + 1);
            return;
        }
        const auto factors = std::ranges::count_if (patch.wires, [&] (const graph::Wire& w) {
            return graph::firstNameOf (w.to.node) == n->name && of (patch, w.from) != 0;
        });
        if (multiplies (n->type) && factors > 1) return;
        unplug (patch, std::string (n->name), {}, kept, depth + 1);
    }
};

/// The nodes of a patch that feed a device, an exposed port, or a node that a wire from outside names.
std::set<std::string> usedIn (const graph::Patch& patch, const std::set<std::string>& from_outside)
{
    std::set<std::string> used = from_outside;
    for (const auto& n : patch.nodes)
        if (n.type.starts_with ("device.") && n.type != "device.position") used.insert (n.name);
    for (const auto& [name, at] : patch.expose.outputs)
        used.insert (graph::firstNameOf (at.node));
    std::vector<std::string> open (used.begin(), used.end());
    while (! open.empty())
    {
        const auto node = open.back();
        open.pop_back();
        for (const auto& w : patch.wires)
            if (graph::firstNameOf (w.to.node) == node)
                if (auto from = graph::firstNameOf (w.from.node); used.insert (from).second) open.push_back (from);
    }
    return used;
}

/// By patch, the nodes that wires and exposed ports of other patches name.
std::map<const graph::Patch*, std::set<std::string>> namedFromOutside (graph::Graph& g)
{
    std::map<const graph::Patch*, std::set<std::string>> named;
    graph::forEachEndpoint (g, [&] (graph::Endpoint&, const graph::Waypoint& w) {
        if (w.begin > 0 && w.side != graph::Side::param) named[w.patch].insert (w.name);
        return true;
    });
    return named;
}

void prune (graph::Graph& g)
{
    std::vector<graph::Command> removed;
    const auto named = namedFromOutside (g);
    const auto visit = [&] (const std::string& name, const graph::Patch& patch) {
        const auto outside = named.find (&patch);
        const auto used = usedIn (patch, outside == named.end() ? std::set<std::string> {} : outside->second);
        for (const auto& n : patch.nodes)
            if (! used.contains (n.name)) removed.push_back (graph::RemoveNode { name, n.name });
    };
    visit ({}, g.root);
    for (const auto& [name, patch] : g.graphs)
        visit (name, patch);
    for (const auto& c : removed)
        (void)graph::apply (g, c);
    std::erase_if (g.controls, [] (const graph::Control& c) { return c.to.empty(); });
}

/// Removes the layers that have no wire any more, because the nodes before them were left out.
void removeEmptyLayers (graph::Graph& g, const Catalogue& catalogue)
{
    for (const auto& at : mixersOf (g))
        for (int i = layersOf (*findMixer (g, at), catalogue); i-- > 0;)
            if (wireInto (g, at, i) == nullptr)
                if (const auto removal = removeLayer (g, at, catalogue, i)) (void)graph::apply (g, *removal);
}
}   // namespace

Parts partsOf (const graph::Graph& given, const Catalogue& catalogue)
{
    auto g = given;
    if (! liftSinks (g)) return {};
    const Sorter sorter (g, catalogue);
    Kinds all = 0;
    for (const auto& n : g.root.nodes)
        for (const auto& port : sinkPortsOf (n))
            for (const auto& w : g.root.wires)
                if (w.to.node == n.name && w.to.port == port.port) all |= sorter.of (g.root, w.from);
    return { (all & wall) != 0, (all & friction) != 0, (all & texture) != 0, (all & vibration) != 0, (all & other) != 0 };
}

void keepOnly (graph::Graph& g, const Parts& kept, const Catalogue& catalogue)
{
    Sorter sorter (g, catalogue);
    const auto nodes = g.root.nodes;
    for (const auto& n : nodes)
        for (const auto& port : sinkPortsOf (n))
            sorter.unplug (g.root, n.name, port.port, bits (kept));
    prune (g);
    removeEmptyLayers (g, catalogue);
}

}   // namespace tactus::host::compose
