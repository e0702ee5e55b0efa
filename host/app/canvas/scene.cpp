// SPDX-License-Identifier: GPL-3.0-or-later
#include "scene.hpp"
#include "arrange.hpp"

#include <framework/graph/endpoints.hpp>
#include <framework/graph/text.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/model/quantities.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
std::size_t at (int i) { return static_cast<std::size_t> (i); }

constexpr std::size_t most_routed = 300;   // nodes; of larger patches each edit would take too long

}   // namespace

Quantity SceneNode::quantityOf (const FacePort& port) const
{
    if (const auto fixed = port.quantity(); fixed != Quantity::any) return fixed;
    const auto found = carried.find ({ port.role, port.id });
    return found == carried.end() ? Quantity::any : found->second;
}

const Socket* SceneNode::paramAt (juce::Point<float> p) const noexcept
{
    const auto socket = std::ranges::find_if (box.sockets, [&] (const Socket& s)
                                              { return s.port->role == Role::param && s.row.translated (at.x, at.y).contains (p); });
    return socket == box.sockets.end() ? nullptr : &*socket;
}

Scene::Scene (const graph::Graph& graph, const std::string& name, const Catalogue& catalogue, const TextWidth& widthOf)
{
    const auto* patch = name.empty() ? &graph.root : graph.find (name);
    if (patch == nullptr) return;
    addNodes (graph, name, *patch, catalogue, widthOf);
    place (*patch);
    findQuantities (*patch, Quantities (graph, catalogue));
    addWires (*patch);
    routeWires();
    addExposed (*patch);
    all_notes = notesOf (graph, name);
}

void Scene::addNodes (const graph::Graph& graph, const std::string& name, const graph::Patch& patch, const Catalogue& catalogue, const TextWidth& widthOf)
{
    for (const auto& node : patch.nodes)
    {
        auto& made = all_nodes.emplace_back();
        made.id = node.id;
        made.name = node.name;
        made.type = node.type;
        made.bypass = node.bypass;
        made.face = std::make_unique<Face> (faceOf (graph, patch, node, catalogue));
        const auto wired = [&] (const FacePort& p)
        {
            return std::ranges::any_of (patch.wires, [&] (const graph::Wire& w)
                                        { return w.to.node == node.name && made.face->endOf (w.to) == &p; });
        };
        made.box = boxOf (
            node, *made.face, wired, [&] (const FacePort& p)
            { return paramNow (graph, name, node, p).value; },
            widthOf);
        numbers.emplace (node.name, static_cast<int> (all_nodes.size()) - 1);
    }
}

void Scene::place (const graph::Patch& patch)
{
    std::vector<juce::Point<float>> sizes;
    std::vector<std::pair<int, int>> wires;
    for (const auto& n : all_nodes)
        sizes.emplace_back (n.box.width, n.box.height);
    for (const auto& w : patch.wires)
        if (const int from = numberOf (w.from.node), to = numberOf (w.to.node); from >= 0 && to >= 0 && w.delay == 0) wires.emplace_back (from, to);
    const auto places = arrange (sizes, wires);
    std::vector<std::size_t> unplaced;
    for (std::size_t i = 0; i < all_nodes.size(); ++i)
    {
        const auto place = placeOf (patch.nodes[i]);
        all_nodes[i].at = place.value_or (places[i]);
        if (! place) unplaced.push_back (i);
    }
    if (unplaced.size() == all_nodes.size()) return;
    for (const auto i : unplaced)
    {
        if (const auto beside = besideOthers (i, unplaced, wires)) all_nodes[i].at = *beside;
        const auto isFree = [&]
        {
            for (std::size_t k = 0; k < all_nodes.size(); ++k)
                if (k != i && all_nodes[k].bounds().expanded (Box::grid).intersects (all_nodes[i].bounds())) return false;
            return true;
        };
        while (! isFree())
            all_nodes[i].at.y += Box::grid;
    }
}

/// Left of what a node leads to, else right of where it comes from, as far as those stand somewhere.
std::optional<juce::Point<float>> Scene::besideOthers (std::size_t i, const std::vector<std::size_t>& unplaced, const std::vector<std::pair<int, int>>& wires) const
{
    constexpr float gap = 64.0f;
    const auto stands = [&] (int node)
    { return at (node) != i && std::ranges::count (unplaced, at (node)) == 0; };
    for (const auto& [from, to] : wires)
        if (at (from) == i && stands (to)) return all_nodes[at (to)].at.translated (-gap - all_nodes[i].box.width, 0.0f);
    for (const auto& [from, to] : wires)
        if (at (to) == i && stands (from)) return all_nodes[at (from)].at.translated (gap + all_nodes[at (from)].box.width, 0.0f);
    return std::nullopt;
}

/// Generic ports take on what is wired to them.
void Scene::findQuantities (const graph::Patch& patch, const Quantities& quantities)
{
    for (std::size_t i = 0; i < all_nodes.size(); ++i)
        for (const auto* ports : { &all_nodes[i].face->inputs, &all_nodes[i].face->params, &all_nodes[i].face->outputs })
            for (const auto& port : *ports)
                if (port.quantity() == Quantity::any)
                    if (const auto q = quantities.of (patch, i, port.role, port.id); q != Quantity::any) all_nodes[i].carried[{ port.role, port.id }] = q;
}

void Scene::addWires (const graph::Patch& patch)
{
    for (const auto& w : patch.wires)
    {
        const int from = numberOf (w.from.node), to = numberOf (w.to.node);
        if (from < 0 || to < 0) continue;
        const auto &a = all_nodes[at (from)], &b = all_nodes[at (to)];
        const auto *start = a.face->startOf (w.from), *end = b.face->endOf (w.to);
        SceneWire wire { .id = w.id, .from = a.bounds().getTopRight().translated (0.0f, Box::header_height / 2), .to = b.at.translated (0.0f, Box::header_height / 2), .start = from, .end = to, .delay = w.delay, .add = w.add, .enabled = w.enabled.value_or (true), .text = graph::toText (w) };
        if (start != nullptr)
        {
            if (const auto* s = a.box.find (start->role, start->id)) wire.from = a.placeOf (*s);
            wire.out = start->id;
            wire.quantity = a.quantityOf (*start);
            wire.width = w.from.component >= 0 ? 1 : start->width;
        }
        if (end != nullptr)
        {
            if (const auto* s = b.box.find (end->role, end->id)) wire.to = b.placeOf (*s);
            wire.in = end->id;
            wire.in_role = end->role;
            if (wire.quantity == Quantity::any) wire.quantity = b.quantityOf (*end);
        }
        all_wires.push_back (std::move (wire));
    }
}

void Scene::addExposed (const graph::Patch& patch)
{
    const auto add = [&] (const std::vector<std::pair<std::string, graph::Endpoint>>& ports, Role role)
    {
        for (const auto& [name, end] : ports)
        {
            const int n = numberOf (end.node);
            if (n < 0) continue;
            const auto& node = all_nodes[at (n)];
            const auto* port = role == Role::output ? node.face->startOf (end) : node.face->endOf (end);
            const auto* socket = port == nullptr ? nullptr : node.box.find (port->role, port->id);
            if (socket != nullptr) all_exposed.push_back ({ node.placeOf (*socket), role, name, node.quantityOf (*port) });
        }
    };
    add (patch.expose.inputs, Role::input);
    add (patch.expose.params, Role::param);
    add (patch.expose.outputs, Role::output);
}

void Scene::routeWires()
{
    if (all_nodes.size() > most_routed) return;
    // A node that nothing is joined to may be about to be put into a wire: none makes way for it.
    std::vector<bool> joined (all_nodes.size());
    for (const auto& w : all_wires)
        joined[at (w.start)] = joined[at (w.end)] = true;
    // Wires that go the same way lie side by side.
    constexpr float apart = 6.0f;
    std::vector<std::pair<juce::Point<float>, juce::Point<float>>> taken;
    const auto isTaken = [&] (juce::Point<float> a, juce::Point<float> b)
    {
        return std::ranges::any_of (taken, [&] (const auto& t)
                                    { return std::abs (t.first.y - a.y) < apart - 1.0f && std::min (t.first.x, t.second.x) < std::max (a.x, b.x) && std::min (a.x, b.x) < std::max (t.first.x, t.second.x); });
    };
    for (auto& w : all_wires)
    {
        std::vector<juce::Rectangle<float>> others;
        for (std::size_t i = 0; i < all_nodes.size(); ++i)
            if (joined[i] && i != at (w.start) && i != at (w.end)) others.push_back (all_nodes[i].bounds());
        w.by = routeAround (w.from, w.to, all_nodes[at (w.start)].bounds(), all_nodes[at (w.end)].bounds(), others);
        for (std::size_t i = 0; i + 1 < w.by.size(); i += 2)
        {
            const float way = w.by[i].y < (w.from.y + w.to.y) / 2 ? -apart : apart;
            while (isTaken (w.by[i], w.by[i + 1]))
            {
                w.by[i].y += way;
                w.by[i + 1].y += way;
            }
            taken.emplace_back (w.by[i], w.by[i + 1]);
        }
    }
}

int Scene::numberOf (const std::string& name) const noexcept
{
    const auto found = numbers.find (graph::firstNameOf (name));
    return found == numbers.end() ? -1 : found->second;
}

juce::Rectangle<float> Scene::bounds() const noexcept
{
    juce::Rectangle<float> all;
    for (const auto& n : all_nodes)
        all = all.isEmpty() ? n.bounds() : all.getUnion (n.bounds());
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

std::optional<std::size_t> Scene::noteAt (juce::Point<float> p) const noexcept
{
    for (std::size_t i = all_notes.size(); i-- > 0;)
        if (const auto& n = all_notes[i]; n.area.contains (p) && (! n.isRegion() || p.y < n.area.getY() + Box::header_height || isCorner (i, p))) return i;
    return std::nullopt;
}

bool Scene::isCorner (std::size_t note, juce::Point<float> p) const noexcept
{
    constexpr float corner = 16.0f;
    return note < all_notes.size() && juce::Rectangle<float> (all_notes[note].area.getRight() - corner, all_notes[note].area.getBottom() - corner, corner, corner).contains (p);
}

std::optional<juce::Point<float>> placeOf (const graph::Node& node)
{
    const auto ui = node.extra.find ("ui");
    if (ui == node.extra.end() || ! ui->is_object()) return std::nullopt;
    const auto place = ui->find ("at");
    if (place == ui->end() || ! place->is_array() || place->size() != 2 || ! (*place)[0].is_number() || ! (*place)[1].is_number()) return std::nullopt;
    const auto x = (*place)[0].get<double>(), y = (*place)[1].get<double>();
    if (! (std::abs (x) < 1e6 && std::abs (y) < 1e6)) return std::nullopt;
    return juce::Point<float> (static_cast<float> (x), static_cast<float> (y));
}

}   // namespace tactus::host
