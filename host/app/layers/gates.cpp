// SPDX-License-Identifier: GPL-3.0-or-later
// Which layers are felt only in contact, also if the gate or the contact window is in a group.
#include "mixer.hpp"
#include "mixer_parts.hpp"

#include <host/app/model/face.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/text/filled.hpp>
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

bool isTouchGain (const graph::Inside& in, const graph::Endpoint& from)
{
    const auto source = sourceOf (in, from);
    return source.node != nullptr && source.node->type == "contact.window" && source.port == "gain";
}

/// True if the gain of a contact window reaches this input of a node, which may come from outside of its group. Without a port: any input.
bool getsTouchGain (const graph::Inside& in, const std::string& node, const std::string& port, int depth)
{
    const auto isMeant = [&] (const graph::Endpoint& end) { return end.node == node && (port.empty() || end.port == port); };
    for (const auto& w : in.patch->wires)
        if (isMeant (w.to) && isTouchGain (in, w.from)) return true;
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

bool isProduct (const graph::Node* n) { return n != nullptr && (n->type == "signal.multiply" || n->type == "vector.scale"); }

/// How often the patch of this subgraph is played, at any depth of the graph; 2 means more than once.
int timesPlayed (const graph::Graph& g, const std::string& name)
{
    int times = 0;
    const auto count = [&] (const graph::Patch& patch) {
        for (const auto& n : patch.nodes)
            if (n.type == "graph:" + name) times += n.extra.contains ("count") ? 2 : 1;   // or more
    };
    count (g.root);
    for (const auto& [_, patch] : g.graphs)
        count (patch);
    return times;
}

/// The place where a layer gets its signal from: a wire in the patch of the mixer, or, if this comes from groups, what the innermost one exposes.
struct Feed
{
    std::string patch;
    graph::Endpoint from;
    const graph::Wire* wire = nullptr;
    std::string exposed {};   ///< the output of the group; "" if `wire` is the place

    graph::Command changedTo (const graph::Graph& g, graph::Endpoint to) const
    {
        if (exposed.empty())
        {
            auto changed = *wire;
            changed.from = std::move (to);
            return graph::ChangeWire { patch, wire->id, std::move (changed) };
        }
        auto shown = findPatch (g, patch)->expose;
        std::ranges::find (shown.outputs, exposed, &std::pair<std::string, graph::Endpoint>::first)->second = std::move (to);
        return graph::ChangeExpose { patch, std::move (shown) };
    }
};

/// The innermost one that an edit changes for this layer only.
Feed feedOf (const graph::Graph& g, const MixerPlace& at, const graph::Wire& w)
{
    Feed feed { at.patch, w.from, &w };
    for (int depth = 0; depth < deepest_subgraph; ++depth)
    {
        const auto* node = findPatch (g, feed.patch)->find (feed.from.node);
        if (node == nullptr || ! node->type.starts_with ("graph:")) break;
        const auto group = node->type.substr (6);
        const auto* inner = findPatch (g, group);
        if (inner == nullptr || timesPlayed (g, group) != 1) break;
        const auto comesFromThere = [&] (const graph::Endpoint& end) { return end.node == feed.from.node && end.port == feed.from.port; };
        const auto& outer = *findPatch (g, feed.patch);
        const auto uses = std::ranges::count_if (outer.wires, comesFromThere, &graph::Wire::from)
                          + std::ranges::count_if (outer.expose.outputs, comesFromThere, &std::pair<std::string, graph::Endpoint>::second);
        if (uses != 1) break;   // or something else would get another signal, too
        const auto shown = std::ranges::find (inner->expose.outputs, feed.from.port, &std::pair<std::string, graph::Endpoint>::first);
        if (shown == inner->expose.outputs.end()) break;
        feed = { group, shown->second, nullptr, feed.from.port };
    }
    return feed;
}

/// True if the signal at the end of a wire is the one at its start.
bool isPlain (const graph::Wire& w)
{
    return w.gain.is_null() && w.delay == 0 && w.enabled.value_or (true) && w.to.component < 0;
}

/// Opens the gate of a layer, wherever it is: the layer gets what the gate multiplies or, if this is more than one plain wire, the wire of the gate goes.
Result<graph::Command> withoutGate (const graph::Graph& g, const Feed& feed)
{
    const auto& patch = *findPatch (g, feed.patch);
    const auto* product = patch.find (feed.from.node);
    std::vector<const graph::Wire*> gates, sources;
    if (isProduct (product))
        for (const auto& in : patch.wires)
            if (in.to.node == product->name) (isTouchGain ({ &g, &patch }, in.from) ? gates : sources).push_back (&in);
    const auto isInput = [&] (const auto& input) { return isProduct (product) && input.second.node == product->name; };
    const auto from_outside = std::ranges::count_if (patch.expose.inputs, isInput);
    if (! gates.empty() && sources.empty() && from_outside == 0)
        return Message::error ("mixer/empty", {}, TRANS ("only the gate is wired into this layer").toStdString(),
                               filled (TRANS ("wire something into %1"), product->name).toStdString());

    graph::Batch batch { NEEDS_TRANS ("open the gate of a layer"), {} };
    const auto factors = static_cast<std::ptrdiff_t> (gates.size()) + from_outside;
    const bool is_simple = factors == 1 && sources.size() == 1 && isPlain (*sources.front()) && feed.from.component < 0;
    const auto isUse = [&] (const graph::Endpoint& end) { return isProduct (product) && end.node == product->name; };
    const auto uses = std::ranges::count_if (patch.wires, isUse, &graph::Wire::from)
                      + std::ranges::count_if (patch.expose.outputs, isUse, &std::pair<std::string, graph::Endpoint>::second);
    if (is_simple)
    {
        batch.commands.push_back (feed.changedTo (g, sources.front()->from));
        if (uses == 1 && from_outside == 0) batch.commands.push_back (graph::RemoveNode { feed.patch, product->name });   // else wires outside lead to it
        return graph::Command (std::move (batch));
    }
    if (gates.empty())
        return Message::error ("mixer/gate_elsewhere", {},
                               TRANS ("the gate of this layer is in a group that something else uses, too, or that gets the signal from outside").toStdString(),
                               TRANS ("open the group, and remove the wire of the gate").toStdString());
    if (uses > 1)
    {
        const auto text = filled (TRANS ("%1 has the gate of this layer, and not only this layer gets its output"), product->name);
        return Message::error ("mixer/gate_shared", {}, text.toStdString(),
                               TRANS ("remove the wire of the gate there, or multiply for this layer apart").toStdString());
    }
    for (const auto* gate : gates)
        batch.commands.push_back (graph::RemoveWire { feed.patch, gate->id });
    return graph::Command (std::move (batch));
}
}   // namespace

bool isGated (const graph::Graph& g, const MixerPlace& at, int layer)
{
    const auto* patch = findPatch (g, at.patch);
    const auto* w = wireInto (g, at, layer);
    if (patch == nullptr || w == nullptr) return false;
    const auto product = sourceOf ({ &g, patch }, w->from);
    return isProduct (product.node) && getsTouchGain (product.in, product.node->name, {}, 0);
}

Result<graph::Command> setGate (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue, int layer, bool on)
{
    const auto* patch = findPatch (g, at.patch);
    const auto* w = wireInto (g, at, layer);
    if (patch == nullptr || findMixer (g, at) == nullptr) return mixing::mixerIsGone();
    if (w == nullptr)
        return Message::error ("mixer/empty", {}, TRANS ("nothing is wired into this layer").toStdString(),
                               TRANS ("wire something into it first").toStdString());
    if (on == isGated (g, at, layer)) return graph::Command (graph::Batch { NEEDS_TRANS ("gate a layer"), {} });
    if (! on) return withoutGate (g, feedOf (g, at, *w));

    graph::Batch batch { NEEDS_TRANS ("gate a layer by contact"), {} };
    auto changed = *w;
    const bool is_vector = at.vectors && w->to.component < 0;
    changed.from = wiring::gated (w->from, is_vector, g, at.patch, wiring::downstreamOf (*patch, at.node), catalogue, batch);
    if (changed.from == w->from)
        return Message::error ("mixer/no_contact", {}, TRANS ("nothing in this patch says how deep the tool presses").toStdString(),
                               TRANS ("add a surface, such as deform.plane").toStdString());
    batch.commands.push_back (graph::ChangeWire { at.patch, w->id, std::move (changed) });
    return graph::Command (std::move (batch));
}

}   // namespace tactus::host
