// SPDX-License-Identifier: GPL-3.0-or-later
// Which layers are felt only in contact, also if the gate or the contact window is in a group.
#include "mixer.hpp"

#include <host/app/model/face.hpp>
#include <host/app/model/patch.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/graph/inside.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// The output of a node of the catalogue.
struct Source
{
    graph::Inside in {};
    const graph::Node* node = nullptr;
    std::string port {};
};

/// The source of the value at the start of a wire. It may be inside of the group that the wire comes from.
Source sourceOf (graph::Inside in, graph::Endpoint from)
{
    for (int depth = 0; depth < deepest_subgraph; ++depth)
    {
        const auto* node = in.patch->find (graph::firstNameOf (from.node));
        if (node == nullptr) return {};
        const auto inner = graph::insideOf (*in.owner, *node);
        if (! inner) return { in, node, from.port };
        const auto& shown = inner.patch->expose.outputs;
        const auto end = std::ranges::find (shown, from.port, &std::pair<std::string, graph::Endpoint>::first);
        if (end == shown.end()) return {};
        from = end->second;
        in = inner;
    }
    return {};
}

/// True if the gain of a contact window reaches this input of a node, which may come from outside of its group. Without a port: any input.
bool getsTouchGain (const graph::Inside& in, const std::string& node, const std::string& port, int depth)
{
    const auto isMeant = [&] (const graph::Endpoint& end) { return end.node == node && (port.empty() || end.port == port); };
    const auto isTouchGain = [&] (const graph::Wire& w) {
        const auto source = sourceOf (in, w.from);
        return source.node != nullptr && source.node->type == "contact.window" && source.port == "gain";
    };
    for (const auto& w : in.patch->wires)
        if (isMeant (w.to) && isTouchGain (w)) return true;
    if (depth == deepest_subgraph) return false;
    for (const auto& [name, end] : in.patch->expose.inputs)
    {
        if (! isMeant (end)) continue;
        const auto comesFrom = [&, shown = name] (const graph::Patch& outer) {
            return std::ranges::any_of (outer.nodes, [&] (const graph::Node& n) {
                return graph::insideOf (*in.owner, n).patch == in.patch && getsTouchGain ({ in.owner, &outer }, n.name, shown, depth + 1);
            });
        };
        if (comesFrom (in.owner->root) || std::ranges::any_of (in.owner->graphs, [&] (const auto& g) { return comesFrom (g.second); })) return true;
    }
    return false;
}
}   // namespace

bool isGated (const graph::Graph& g, const MixerPlace& at, int layer)
{
    const auto* patch = findPatch (g, at.patch);
    const auto* w = wireInto (g, at, layer);
    if (patch == nullptr || w == nullptr) return false;
    const auto product = sourceOf ({ &g, patch }, w->from);
    const bool multiplies = product.node != nullptr && (product.node->type == "signal.multiply" || product.node->type == "vector.scale");
    return multiplies && getsTouchGain (product.in, product.node->name, {}, 0);
}

}   // namespace tactus::host
