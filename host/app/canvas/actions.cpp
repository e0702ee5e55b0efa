// SPDX-License-Identifier: GPL-3.0-or-later
#include "actions.hpp"

#include <host/app/model/fragment.hpp>
#include <host/app/model/param_value.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/wire_rules.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/plan/rules/fan_in.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
const graph::Patch& patchOf (const graph::Graph& g, const std::string& name)
{
    static const graph::Patch none;
    const auto* patch = findPatch (g, name);
    return patch == nullptr ? none : *patch;
}

graph::Endpoint endpoint (const std::string& node, const FacePort& port, int component = -1)
{
    const auto entry = entryOf (port.id);
    return { node, baseOf (port.id), entry ? static_cast<int> (*entry) : -1, component };
}

Json toJson (juce::Point<float> at) { return Json::array ({ std::round (static_cast<double> (at.x)), std::round (static_cast<double> (at.y)) }); }

/// True if both ends are the same component of the same port, or if one of them is the whole vector.
bool overlap (const graph::Endpoint& a, const graph::Endpoint& b)
{
    return a.node == b.node && a.port == b.port && a.index == b.index && (a.component == b.component || a.component < 0 || b.component < 0);
}

std::vector<std::string> namesOf (const graph::Patch& patch, const Selection& ids)
{
    std::vector<std::string> names;
    for (const auto& n : patch.nodes)
        if (ids.contains (n.id)) names.push_back (n.name);
    return names;
}

/// The wires that replace a deleted node, if its input fits its destinations.
std::vector<graph::Wire> healed (const graph::Patch& patch, const Scene& scene, const SceneNode& gone)
{
    std::vector<const graph::Wire*> in, out;
    for (const auto& w : patch.wires)
    {
        const auto* end = w.to.node == gone.name ? gone.face->endOf (w.to) : nullptr;
        if (end != nullptr && end->role == Role::input) in.push_back (&w);
        if (w.from.node == gone.name) out.push_back (&w);
    }
    if (in.size() != 1) return {};
    const auto start = std::ranges::find (scene.nodes(), graph::firstNameOf (in[0]->from.node), &SceneNode::name);
    const auto* from = start == scene.nodes().end() ? nullptr : start->face->startOf (in[0]->from);
    if (from == nullptr) return {};
    std::vector<graph::Wire> wires;
    for (const auto* w : out)
    {
        const auto end = std::ranges::find (scene.nodes(), graph::firstNameOf (w->to.node), &SceneNode::name);
        const auto* to = end == scene.nodes().end() ? nullptr : end->face->endOf (w->to);
        if (to == nullptr) continue;
        const auto carried = start->quantityOf (*from), taken = end->quantityOf (*to);
        if ((carried != taken && taken != Quantity::any) || ! checkWire ({ from, carried }, { to, taken })) continue;
        graph::Wire through;
        through.from = in[0]->from;
        through.to = w->to;
        through.delay = in[0]->delay + w->delay;
        wires.push_back (through);
    }
    return wires;
}
}   // namespace

graph::Command placeNodes (const graph::Graph& g, const std::string& patch, const std::vector<std::pair<graph::Id, juce::Point<float>>>& places)
{
    graph::Batch batch { places.size() == 1 ? NEEDS_TRANS ("move node") : NEEDS_TRANS ("move nodes"), {} };
    for (const auto& [id, at] : places)
    {
        const auto& nodes = patchOf (g, patch).nodes;
        const auto node = std::ranges::find (nodes, id, &graph::Node::id);
        if (node == nodes.end()) continue;
        auto ui = node->extra.value ("ui", Json::object());
        if (! ui.is_object()) ui = Json::object();
        ui["at"] = toJson (at);
        batch.commands.push_back (graph::SetNodeKey { patch, node->name, "ui", ui });
    }
    return batch;
}

graph::Command removeSelected (const graph::Graph& g, const std::string& name, const Scene& scene, const Selection& ids)
{
    const auto& patch = patchOf (g, name);
    graph::Batch batch { NEEDS_TRANS ("delete"), {} };
    const auto names = namesOf (patch, ids);
    const auto goes = [&] (const std::string& node) { return std::ranges::count (names, graph::firstNameOf (node)) > 0; };

    std::vector<graph::Wire> through;
    for (const auto& n : scene.nodes())
        if (ids.contains (n.id))
            for (auto& w : healed (patch, scene, n))
                if (! goes (w.from.node) && ! goes (w.to.node)) through.push_back (std::move (w));
    for (const auto& w : patch.wires)
        if (ids.contains (w.id) && ! goes (w.from.node) && ! goes (w.to.node)) batch.commands.push_back (graph::RemoveWire { name, w.id });
    for (const auto& n : names)
        batch.commands.push_back (graph::RemoveNode { name, n });
    for (auto& w : through)
        batch.commands.push_back (graph::AddWire { name, std::move (w) });
    return batch;
}

graph::Command toggleBypass (const graph::Graph& g, const std::string& name, const Selection& ids)
{
    bool any_runs = false;
    for (const auto& n : patchOf (g, name).nodes)
        any_runs = any_runs || (ids.contains (n.id) && ! n.bypass);
    graph::Batch batch { any_runs ? NEEDS_TRANS ("bypass") : NEEDS_TRANS ("end bypass"), {} };
    for (const auto& n : patchOf (g, name).nodes)
        if (ids.contains (n.id) && n.bypass != any_runs)
            batch.commands.push_back (graph::SetNodeKey { name, n.name, "bypass", any_runs ? std::optional<Json> (true) : std::nullopt });
    return batch;
}

std::optional<graph::Command> group (const graph::Graph& g, const std::string& name, const Selection& ids)
{
    const auto& patch = patchOf (g, name);
    auto names = namesOf (patch, ids);
    if (names.empty()) return std::nullopt;
    std::string subgraph = "group";
    for (int i = 2; g.find (subgraph) != nullptr; ++i)
        subgraph = "group_" + std::to_string (i);
    return graph::CollapseNodes { name, std::move (names), freeName (patch, {}, subgraph), subgraph };
}

graph::Command addNode (const graph::Graph& g, const std::string& patch, const std::string& type, std::optional<juce::Point<float>> at, graph::Id& made)
{
    graph::Node node;
    node.name = freeName (patchOf (g, patch), {}, usualName (type));
    node.type = type;
    if (at) node.extra["ui"] = Json { { "at", toJson (*at) } };
    made = node.id;
    if (! type.starts_with ("device.")) return graph::AddNode { patch, std::move (node) };
    // A device node needs a device role. If the graph has none, also adds one.
    graph::Batch all { "add '" + node.name + "'", {} };
    if (g.devices.empty()) all.commands.push_back (graph::SetDevice { "stylus", newTool() });
    node.role = g.devices.empty() ? "stylus" : g.devices.front().first;
    all.commands.push_back (graph::AddNode { patch, std::move (node) });
    return all;
}

graph::Command connect (const graph::Graph& g, const std::string& patch, const Plug& from, const Plug& to)
{
    graph::Wire wire;
    wire.from = endpoint (from.node.name, from.port, from.component);
    wire.to = endpoint (to.node.name, to.port, to.component);
    const bool several = to.port.role == Role::input && plan::addsUp (to.node.quantityOf (to.port));
    graph::Batch batch { NEEDS_TRANS ("connect"), {} };
    for (const auto& w : patchOf (g, patch).wires)
        if (overlap (w.to, wire.to) && (! several || w.from == wire.from)) batch.commands.push_back (graph::RemoveWire { patch, w.id });
    batch.commands.push_back (graph::AddWire { patch, wire });
    return batch;
}

std::optional<graph::Command> duplicate (const graph::Graph& g, const std::string& name, const Scene& scene, const Selection& ids, Selection& made)
{
    constexpr float beside = 32.0f;
    const auto& patch = patchOf (g, name);
    graph::Batch all { NEEDS_TRANS ("duplicate"), {} };
    Selection copies;
    auto pasted = paste (g, name, fragmentOf (g, name, ids), { beside, beside }, copies);
    if (pasted && ! copies.empty())
    {
        // The copies are in the order of the originals.
        std::vector<std::string> names;
        for (const auto& c : std::get<graph::Batch> (pasted->edit).commands)
            if (const auto* add = std::get_if<graph::AddNode> (&c.edit)) names.push_back (add->node.name);
        const auto originals = namesOf (patch, ids);
        all.commands.push_back (*std::move (pasted));
        for (const auto& w : patch.wires)
        {
            const auto copy = std::ranges::find (originals, w.to.node);
            if (copy == originals.end() || std::ranges::count (originals, graph::firstNameOf (w.from.node)) > 0) continue;
            graph::Wire in = w;
            in.id = graph::newId();
            in.to.node = names[static_cast<std::size_t> (copy - originals.begin())];
            all.commands.push_back (graph::AddWire { name, withBends (std::move (in), {}) });
        }
    }
    made = std::move (copies);
    auto notes = scene.notes();
    const auto count = notes.size();
    for (std::size_t i = 0; i < count; ++i)
        if (ids.contains (noteId (i)))
        {
            made.insert (noteId (notes.size()));
            notes.push_back (notes[i]);
            notes.back().area += juce::Point<float> (beside, beside);
        }
    if (notes.size() > count) all.commands.push_back (setNotes (g, name, notes, NEEDS_TRANS ("duplicate")));
    if (made.empty()) return std::nullopt;
    return all;
}

std::optional<graph::Command> insertInto (const graph::Graph& g, const std::string& patch, const Scene& scene, graph::Id wire_id, graph::Id node_id)
{
    const auto& wires = patchOf (g, patch).wires;
    const auto wire = std::ranges::find (wires, wire_id, &graph::Wire::id);
    const auto* shown = scene.findWire (wire_id);
    const auto* node = scene.find (node_id);
    if (wire == wires.end() || shown == nullptr || node == nullptr || shown->start < 0 || shown->end < 0) return std::nullopt;
    const auto &a = scene.nodes()[static_cast<std::size_t> (shown->start)], &b = scene.nodes()[static_cast<std::size_t> (shown->end)];
    const auto *start = a.face->startOf (wire->from), *end = b.face->endOf (wire->to);
    if (start == nullptr || end == nullptr || a.id == node_id || b.id == node_id) return std::nullopt;

    for (const auto& in : node->face->inputs)
        for (const auto& out : node->face->outputs)
        {
            if (! checkWire ({ start, a.quantityOf (*start) }, { &in, node->quantityOf (in) })) continue;
            if (! checkWire ({ &out, node->quantityOf (out) }, { end, b.quantityOf (*end) })) continue;
            graph::Wire first = withBends (*wire, {}), second;
            first.to = endpoint (node->name, in);
            first.add = false;
            second.from = endpoint (node->name, out);
            second.to = wire->to;
            second.add = wire->add;
            return graph::Batch { NEEDS_TRANS ("insert"),
                                  { graph::ChangeWire { patch, wire_id, std::move (first) }, graph::AddWire { patch, std::move (second) } } };
        }
    return std::nullopt;
}

namespace
{
/// The area of a node or a note that covers a part of an area. Empty if nothing does, other than the node `own`.
juce::Rectangle<float> coverOf (const Scene& scene, juce::Rectangle<float> area, graph::Id own = 0)
{
    for (const auto& n : scene.nodes())
        if (n.id != own && n.bounds().intersects (area)) return n.bounds();
    for (const auto& n : scene.notes())
        if (! n.isRegion() && n.area.intersects (area)) return n.area;
    return {};
}

juce::Rectangle<float> usualBox (juce::Point<float> at) { return { at.x, at.y, 160.0f, 96.0f }; }
}   // namespace

juce::Point<float> freePlace (const Scene& scene, juce::Rectangle<float> box, graph::Id own)
{
    while (! coverOf (scene, box.expanded (Box::grid), own).isEmpty())   // a node that touched its neighbour would look like a part of it
        box.translate (0.0f, 2 * Box::grid);
    return box.getPosition();
}

juce::Point<float> freePlace (const Scene& scene, juce::Point<float> at) { return freePlace (scene, usualBox (at), 0); }

juce::Point<float> placeInRow (const Scene& scene, juce::Point<float> at, bool to_the_left)
{
    constexpr float gap = 4 * Box::grid, high = 240.0f;   // of a node with many ports
    auto cover = coverOf (scene, usualBox (at));
    if (! cover.isEmpty()) at.y = cover.getY();
    for (; ! cover.isEmpty(); cover = coverOf (scene, usualBox (at).withHeight (high)))
        at.x = to_the_left ? cover.getX() - gap - usualBox (at).getWidth() : cover.getRight() + gap;
    return at;
}

}   // namespace tactus::host
