// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene.hpp"
#include "arrange.hpp"

#include <host/app/inspector/modulation.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/quantities.hpp>
#include <tactus/graph/endpoint_text.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/kit/at.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace tactus::host
{

namespace
{
constexpr std::size_t most_routed = 300;   // nodes; routing a larger patch would slow down every edit
constexpr std::size_t most_moving = 60;    // nodes of a patch in which all wires may be routed at each step of a drag

/// The place where something connects to a node that does not show its port, such as one deeper inside a subgraph; relative to the node.
juce::Point<float> besideHeader (const SceneNode& n, bool is_output) { return { is_output ? n.box.width : 0.0f, Box::header_height / 2 }; }
}   // namespace

Quantity SceneNode::quantityOf (const FacePort& port) const
{
    if (const auto fixed = port.quantity(); fixed != Quantity::any) return fixed;
    const auto found = carried.find ({ port.role, port.id });
    return found == carried.end() ? Quantity::any : found->second;
}

const Socket* SceneNode::paramAt (juce::Point<float> p) const noexcept
{
    const auto socket = std::ranges::find_if (box.sockets,
                                              [&] (const Socket& s) { return s.port->role == Role::param && s.row.translated (at.x, at.y).contains (p); });
    return socket == box.sockets.end() ? nullptr : &*socket;
}

Scene::Scene (const graph::Graph& graph, const SeenPatch& seen, const Catalogue& catalogue, NodeCurves& curves, KeptPlaces& kept, const TextWidth& widthOf)
{
    const auto* patch = findPatch (graph, seen.name);
    if (patch == nullptr) return;
    addNodes (graph, seen, *patch, catalogue, curves, widthOf);
    findQuantities (*patch, Quantities (graph, catalogue));
    addWires (*patch);
    layOut (graph, seen, *patch, kept, widthOf);
}

Scene::Scene (const Scene& before, const graph::Graph& graph, const SeenPatch& seen, KeptPlaces& kept, const TextWidth& widthOf,
              bool wires_may_stay)
    : all_nodes (before.all_nodes), all_wires (before.all_wires), indices (before.indices)
{
    const auto* patch = findPatch (graph, seen.name);
    if (patch == nullptr) return;
    is_routed = ! wires_may_stay || all_nodes.size() <= most_moving || all_nodes.size() > most_routed;
    layOut (graph, seen, *patch, kept, widthOf, &before, wires_may_stay);
}

void Scene::layOut (const graph::Graph& graph, const SeenPatch& seen, const graph::Patch& patch, KeptPlaces& kept, const TextWidth& widthOf,
                    const Scene* before, bool is_dragged)
{
    all_notes = notesOf (graph, seen.name);
    place (patch, kept);
    for (auto& w : all_wires)
    {
        const auto &a = all_nodes[at (w.start)], &b = all_nodes[at (w.end)];
        w.from = a.at + leaveOf (w);
        w.to = b.at + entryOf (w);
    }
    routeWires (before, is_dragged);
    addExposed (patch, widthOf);
}

void Scene::addNodes (const graph::Graph& graph, const SeenPatch& seen, const graph::Patch& patch, const Catalogue& catalogue, NodeCurves& curves,
                      const TextWidth& widthOf)
{
    std::map<std::string_view, std::vector<const graph::Endpoint*>> ends_at;   // by node: where wires end, and what is exposed
    std::map<std::string_view, std::vector<const graph::Wire*>> wires_to;
    for (const auto& w : patch.wires)
    {
        ends_at[w.to.node].push_back (&w.to);
        wires_to[w.to.node].push_back (&w);
    }
    for (const auto* exposed : { &patch.expose.inputs, &patch.expose.params })
        for (const auto& [name, end] : *exposed)
            ends_at[end.node].push_back (&end);
    const auto outside = drivenFromOutside (graph, seen);
    for (const auto& node : patch.nodes)
    {
        auto& made = all_nodes.emplace_back();
        made.id = node.id;
        made.name = node.name;
        made.type = node.type;
        made.bypass = node.bypass;
        made.face = std::make_shared<const Face> (faceOf (graph, patch, node, catalogue));
        const auto wired = [&, &its = ends_at[node.name]] (const FacePort& p) {
            return std::ranges::any_of (its, [&] (const graph::Endpoint* e) { return made.face->endOf (*e) == &p; })
                   || (! outside.empty() && outside.contains (node.name + '.' + p.id));
        };
        const auto driver = [&, &its = wires_to[node.name]] (const FacePort& p) {
            const auto wire = std::ranges::find_if (its, [&] (const graph::Wire* w) { return drives (*w, p); });
            if (wire != its.end()) return graph::toText ((*wire)->from);
            const auto outer = outside.empty() ? outside.end() : outside.find (node.name + '.' + p.id);
            return outer == outside.end() ? std::string() : outer->second;
        };
        const auto valueNow = [&] (const FacePort& p) { return paramNow (graph, seen, node, p).value; };
        const auto depth = [&, is_modulated = std::ranges::any_of (wires_to[node.name], &graph::Wire::add)] (const FacePort& p) {
            std::string text;
            for (const auto& m : is_modulated ? modulationsOf (graph, seen.name, node.name, p, catalogue) : std::vector<Modulation> {})
                text += (text.empty() ? "" : " ") + sizeOf (m).toStdString();
            return text;
        };
        made.curve = curves.of (graph, seen, node, *made.face);
        made.box = boxOf (node, *made.face, wired, valueNow, driver, depth, made.curve != nullptr, widthOf);
        indices.emplace (node.name, static_cast<int> (all_nodes.size()) - 1);
    }
}

/// A text of everything that the automatic places depend on: the nodes, their ports, the places that are stored, and the wires. Values are left out,
/// though their texts make nodes wider.
std::string Scene::shapeFor (const std::vector<bool>& placed) const
{
    std::string shape;
    const auto add = [&shape] (auto number) { shape += std::to_string (number) + ' '; };
    for (std::size_t i = 0; i < all_nodes.size(); ++i)
    {
        const auto& n = all_nodes[i];
        add (n.id);
        add (n.face->inputs.size());
        add (n.face->outputs.size());
        if (! placed[i]) continue;
        add (n.at.x);
        add (n.at.y);
    }
    for (const auto& w : all_wires)
    {
        if (w.delay != 0) continue;
        add (w.start);
        add (w.end);
    }
    return shape;
}

const std::vector<juce::Point<float>>* KeptPlaces::find (const std::string& shape) const
{
    const auto found = known.find (shape);
    return found == known.end() ? nullptr : &found->second;
}

void KeptPlaces::keep (std::string shape, std::vector<juce::Point<float>> places)
{
    constexpr std::size_t most = 64;
    if (known.size() >= most) known.clear();
    known.emplace (std::move (shape), std::move (places));
}

void Scene::place (const graph::Patch& patch, KeptPlaces& kept)
{
    std::vector<bool> placed (all_nodes.size());
    for (std::size_t i = 0; i < all_nodes.size(); ++i)
        if (const auto stored = positionOf (patch.nodes[i]))
        {
            all_nodes[i].at = stored->toFloat();
            placed[i] = true;
        }
    if (std::ranges::count (placed, false) == 0) return;
    auto shape = shapeFor (placed);
    if (const auto* places = kept.find (shape))
    {
        for (std::size_t i = 0; i < all_nodes.size(); ++i)
            all_nodes[i].at = (*places)[i];
        return;
    }
    std::ranges::count (placed, true) > 0 ? placeAmongOthers (std::move (placed)) : placeAll();
    std::vector<juce::Point<float>> places;
    for (const auto& n : all_nodes)
        places.push_back (n.at);
    kept.keep (std::move (shape), std::move (places));
}

void Scene::placeAll()
{
    std::vector<juce::Point<float>> sizes;
    std::vector<std::pair<int, int>> wires;
    for (const auto& n : all_nodes)
        sizes.emplace_back (n.box.width, n.box.height);
    for (const auto& w : all_wires)
        if (w.delay == 0) wires.emplace_back (w.start, w.end);
    const auto places = arrange (sizes, wires);
    for (std::size_t i = 0; i < all_nodes.size(); ++i)
        all_nodes[i].at = places[i];
}

void Scene::placeAmongOthers (std::vector<bool> placed)
{
    std::vector<juce::Rectangle<float>> boxes;
    std::vector<Lead> leads;
    for (const auto& n : all_nodes)
        boxes.push_back (n.bounds());
    for (const auto& n : all_notes)
        if (! n.isRegion()) boxes.push_back (n.area);
    placed.resize (boxes.size(), true);
    for (const auto& w : all_wires)
        if (w.delay == 0) leads.push_back ({ w.start, w.end, leaveOf (w), entryOf (w) });
    placeAmong (boxes, std::move (placed), leads);
    for (std::size_t i = 0; i < all_nodes.size(); ++i)
        all_nodes[i].at = boxes[i].getPosition();
}

/// A generic port takes on the quantity wired to it.
void Scene::findQuantities (const graph::Patch& patch, const Quantities& quantities)
{
    for (std::size_t i = 0; i < all_nodes.size(); ++i)
        for (const auto* ports : { &all_nodes[i].face->inputs, &all_nodes[i].face->params, &all_nodes[i].face->outputs })
            for (const auto& port : *ports)
            {
                if (port.quantity() != Quantity::any) continue;
                const auto q = quantities.of (patch, i, port.role, port.id);
                if (q != Quantity::any) all_nodes[i].carried[{ port.role, port.id }] = q;
            }
}

void Scene::addWires (const graph::Patch& patch)
{
    for (const auto& w : patch.wires)
    {
        const int from = indexOf (w.from.node), to = indexOf (w.to.node);
        if (from < 0 || to < 0) continue;
        const auto &a = all_nodes[at (from)], &b = all_nodes[at (to)];
        const auto *start = a.face->startOf (w.from), *end = b.face->endOf (w.to);
        SceneWire wire { .id = w.id,
                         .from = {},
                         .to = {},
                         .start = from,
                         .end = to,
                         .delay = w.delay,
                         .add = w.add,
                         .enabled = w.enabled.value_or (true),
                         .source = graph::toText (w.from),
                         .text = graph::toText (w) };
        if (start != nullptr)
        {
            wire.out = start->id;
            wire.quantity = a.quantityOf (*start);
            wire.width = w.from.component >= 0 ? 1 : start->width;
        }
        if (end != nullptr)
        {
            wire.in = end->id;
            wire.in_role = end->role;
            if (wire.quantity == Quantity::any) wire.quantity = b.quantityOf (*end);
        }
        for (const auto& b : bendsOf (w))
            wire.waypoints.push_back (b.toFloat());
        wire.has_bends = ! wire.waypoints.empty();
        all_wires.push_back (std::move (wire));
    }
}

/// The place where a wire leaves its first node, relative to this node.
juce::Point<float> Scene::leaveOf (const SceneWire& w) const
{
    const auto& node = all_nodes[at (w.start)];
    const auto* socket = node.box.find (Role::output, w.out);
    return socket == nullptr ? besideHeader (node, true) : socket->at;
}

juce::Point<float> Scene::entryOf (const SceneWire& w) const
{
    const auto& node = all_nodes[at (w.end)];
    const auto* socket = node.box.find (w.in_role, w.in);
    return socket == nullptr ? besideHeader (node, false) : socket->at;
}

void Scene::addExposed (const graph::Patch& patch, const TextWidth& widthOf)
{
    constexpr float height = 18.0f, stem = 14.0f, padding = 14.0f, text_size = 11.0f;
    const auto add = [&] (const std::vector<std::pair<std::string, graph::Endpoint>>& ports, Role role) {
        for (const auto& [name, end] : ports)
        {
            const int n = indexOf (end.node);
            if (n < 0) continue;
            const auto& node = all_nodes[at (n)];
            const auto* port = role == Role::output ? node.face->startOf (end) : node.face->endOf (end);
            const auto* socket = port == nullptr || end.node != node.name ? nullptr : node.box.find (port->role, port->id);
            const auto place = node.at + (socket != nullptr ? socket->at : besideHeader (node, role == Role::output));
            const float width = widthOf (name, text_size, true) + padding, x = role == Role::output ? place.x + stem : place.x - stem - width;
            const auto quantity = socket != nullptr ? node.quantityOf (*port) : Quantity::any;
            all_exposed.push_back ({ place, role, name, quantity, { x, place.y - height / 2, width, height } });
        }
    };
    add (patch.expose.inputs, Role::input);
    add (patch.expose.params, Role::param);
    add (patch.expose.outputs, Role::output);
}

/// The nodes that wires are routed around: all but an unconnected one that is being dragged, because the user may be about to insert it into a wire.
std::vector<bool> Scene::obstacles (const Scene* before, bool is_dragged) const
{
    std::vector<bool> all (all_nodes.size(), true);
    if (! is_dragged) return all;
    for (std::size_t i = 0; i < all.size(); ++i)
        all[i] = before->all_nodes[i].at == all_nodes[i].at;
    for (const auto& w : all_wires)
        all[at (w.start)] = all[at (w.end)] = true;
    return all;
}

/// Wires that stay as they were before are routed first, so that the others run beside them.
void Scene::routeWires (const Scene* before, bool is_dragged)
{
    if (all_nodes.size() > most_routed) return;
    const auto stays = [&] (const SceneWire& w) {
        const auto isThere = [&] (int node) { return before->all_nodes[at (node)].at == all_nodes[at (node)].at; };
        return ! is_routed && isThere (w.start) && isThere (w.end);
    };
    const auto is_obstacle = obstacles (before, is_dragged);
    // Parallel wires run side by side.
    constexpr float apart = 6.0f;
    std::map<int, std::vector<std::pair<juce::Point<float>, juce::Point<float>>>> taken;   // by level
    const auto levelOf = [] (juce::Point<float> p) { return static_cast<int> (std::floor (p.y / apart)); };
    const auto isTaken = [&] (juce::Point<float> a, juce::Point<float> b) {
        const auto overlaps = [&] (const auto& t) {
            const bool is_level = std::abs (t.first.y - a.y) < apart - 1.0f;
            return is_level && std::min (t.first.x, t.second.x) < std::max (a.x, b.x) && std::min (a.x, b.x) < std::max (t.first.x, t.second.x);
        };
        for (int level = levelOf (a) - 1; level <= levelOf (a) + 1; ++level)
            if (const auto at = taken.find (level); at != taken.end() && std::ranges::any_of (at->second, overlaps)) return true;
        return false;
    };
    for (const auto& w : all_wires)
        if (! w.has_bends && stays (w))
            for (std::size_t i = 0; i + 1 < w.waypoints.size(); i += 2)
                taken[levelOf (w.waypoints[i])].emplace_back (w.waypoints[i], w.waypoints[i + 1]);
    for (auto& w : all_wires)
    {
        if (w.has_bends || stays (w)) continue;
        std::vector<juce::Rectangle<float>> others;
        for (std::size_t i = 0; i < all_nodes.size(); ++i)
            if (is_obstacle[i] && i != at (w.start) && i != at (w.end)) others.push_back (all_nodes[i].bounds());
        w.waypoints = routeAround (w.from, w.to, all_nodes[at (w.start)].bounds(), all_nodes[at (w.end)].bounds(), others);
        for (std::size_t i = 0; i + 1 < w.waypoints.size(); i += 2)
        {
            auto &a = w.waypoints[i], &b = w.waypoints[i + 1];
            const float step = a.y < (w.from.y + w.to.y) / 2 ? -apart : apart;
            for (; isTaken (a, b); b.y += step)
                a.y += step;
            taken[levelOf (a)].emplace_back (a, b);
        }
    }
    if (! std::ranges::all_of (is_obstacle, std::identity())) is_routed = false;
}

int Scene::indexOf (const std::string& name) const noexcept
{
    const auto found = indices.find (graph::firstNameOf (name));
    return found == indices.end() ? -1 : found->second;
}

juce::Rectangle<float> Scene::bounds() const noexcept
{
    juce::Rectangle<float> all;
    for (const auto& n : all_nodes)
        all = all.isEmpty() ? n.bounds() : all.getUnion (n.bounds());
    for (const auto& e : all_exposed)
        all = all.getUnion (e.label);
    for (const auto& n : all_notes)
        all = all.isEmpty() ? n.area : all.getUnion (n.area);
    return all;
}

const SceneNode* Scene::find (graph::Id id) const noexcept
{
    const auto node = std::ranges::find (all_nodes, id, &SceneNode::id);
    return node == all_nodes.end() ? nullptr : &*node;
}

const SceneWire* Scene::findWire (graph::Id id) const noexcept
{
    const auto wire = std::ranges::find (all_wires, id, &SceneWire::id);
    return wire == all_wires.end() ? nullptr : &*wire;
}

ScenePort Scene::findPort (const PortId& id) const noexcept
{
    const auto* node = find (id.node);
    return { node, node == nullptr ? nullptr : node->face->find (id.role, id.port) };
}

juce::Rectangle<float> boundsOf (const SceneWire& w)
{
    juce::Rectangle<float> all { w.from, w.to };
    if (w.has_bends) return w.path().getBounds().expanded (16.0f);
    for (const auto& p : w.waypoints)
        all = all.getUnion (juce::Rectangle<float> (p, p).expanded (1.0f));
    return all.expanded (200.0f, 16.0f);
}

const SceneNode* Scene::nodeAt (juce::Point<float> p) const noexcept
{
    for (auto n = all_nodes.rbegin(); n != all_nodes.rend(); ++n)
        if (n->bounds().contains (p)) return &*n;
    return nullptr;
}

const SceneWire* Scene::wireAt (juce::Point<float> p, float reach) const
{
    const auto near = wiresAt (p, reach);
    return near.empty() ? nullptr : near.front();
}

std::vector<const SceneWire*> Scene::wiresAt (juce::Point<float> p, float reach) const
{
    std::vector<std::pair<float, const SceneWire*>> near;
    for (const auto& w : all_wires)
    {
        if (! boundsOf (w).expanded (reach).contains (p)) continue;
        const auto path = w.path();
        if (! path.getBounds().expanded (reach).contains (p)) continue;
        juce::Point<float> on_path;
        path.getNearestPoint (p, on_path);
        if (const float distance = on_path.getDistanceFrom (p); distance <= reach) near.emplace_back (distance, &w);
    }
    std::ranges::stable_sort (near, {}, &std::pair<float, const SceneWire*>::first);
    std::vector<const SceneWire*> wires;
    for (const auto& [distance, w] : near)
        wires.push_back (w);
    return wires;
}

SceneSocket Scene::socketAt (juce::Point<float> p, float reach) const noexcept
{
    SceneSocket nearest;
    for (const auto& n : all_nodes)
    {
        if (! n.bounds().expanded (reach).contains (p)) continue;
        for (const auto& s : n.box.sockets)
            if (const float distance = n.placeOf (s).getDistanceFrom (p); distance <= reach)
            {
                reach = distance;
                nearest = { &n, &s };
            }
    }
    return nearest;
}

std::optional<Bend> Scene::bendAt (juce::Point<float> p, float reach) const noexcept
{
    std::optional<Bend> nearest;
    for (const auto& w : all_wires)
        for (std::size_t i = 0; w.has_bends && i < w.waypoints.size(); ++i)
            if (const float distance = w.waypoints[i].getDistanceFrom (p); distance <= reach)
            {
                reach = distance;
                nearest = { w.id, i };
            }
    return nearest;
}

std::optional<std::size_t> Scene::noteAt (juce::Point<float> p) const noexcept
{
    for (std::size_t i = all_notes.size(); i-- > 0;)
    {
        const auto& n = all_notes[i];
        if (n.area.contains (p) && (! n.isRegion() || p.y < n.area.getY() + Box::header_height || isCorner (i, p))) return i;
    }
    return std::nullopt;
}

bool Scene::isCorner (std::size_t note, juce::Point<float> p) const noexcept
{
    constexpr float corner = 16.0f;
    if (note >= all_notes.size()) return false;
    auto area = all_notes[note].area;
    return area.removeFromBottom (corner).removeFromRight (corner).contains (p);
}

}   // namespace tactus::host
