// SPDX-License-Identifier: GPL-3.0-or-later
// What the canvas shows about the thing under the pointer, and what it shows of the run.
#include "canvas.hpp"
#include "paint/paint_nodes.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/quantity_text.hpp>
#include <host/app/model/readable.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

namespace
{
std::string nameOf (const FacePort& port) { return readableName (port) == port.id ? port.id : nameWithId (port.id); }

/// "drag.force  [N]  force on the tool"
juce::String portText (const SceneNode& node, const FacePort& port)
{
    const auto unit = port.unit.kind == UnitRule::Kind::fixed ? port.unit.unit : unitOf (node.quantityOf (port));
    return fromUtf8 (node.name + "." + port.id + "  [" + unitShown (std::string (unit.symbol)) + "]  " + port.about);
}

/// The port whose socket or label is at a place.
const Socket* socketOf (const SceneNode& node, juce::Point<float> at)
{
    const auto found = std::ranges::find_if (node.box.sockets, [&] (const Socket& s) { return s.row.translated (node.at.x, node.at.y).contains (at); });
    return found == node.box.sockets.end() ? nullptr : &*found;
}
}   // namespace

std::optional<Bend> Canvas::bendAt (juce::Point<float> at, bool of_selected) const
{
    const auto bend = shown->bendAt (at, socket_reach / window.zoom);
    return bend && highlights.selected.contains (bend->wire) == of_selected ? bend : std::nullopt;
}

const SceneWire* Canvas::wireUnder (juce::Point<float> at) const
{
    const bool is_covered = shown->socketAt (at, socket_reach / window.zoom) || shown->nodeAt (at) != nullptr;
    return is_covered ? nullptr : shown->wireAt (at, wire_reach / window.zoom);
}

Canvas::Hover Canvas::hoverAt (juce::Point<float> at, const SceneWire* wire) const
{
    const auto overBend = [] (const Bend& bend) -> Hover {
        return { bend.wire, TRANS ("Bend: drag to move; double-click or Delete removes it"), juce::MouseCursor::DraggingHandCursor };
    };
    if (const auto bend = bendAt (at, true)) return overBend (*bend);
    if (const auto s = shown->socketAt (at, socket_reach / window.zoom))
        return { s.node->id, portText (*s.node, *s.socket->port), juce::MouseCursor::CrosshairCursor };
    if (const auto* node = shown->nodeAt (at))
    {
        const auto* socket = node->paramAt (at);
        if (socket != nullptr && ! socket->driver.empty())
            return { node->id, filled (TRANS ("%1: %2. A wire from %3 sets it"), nameOf (*socket->port), socket->port->about, socket->driver) };
        if (socket != nullptr && ! socket->port->isChoice() && socket->port->width != 1)
            return { node->id, filled (TRANS ("%1: %2. Double-click to type it"), nameOf (*socket->port), socket->port->about) };
        if (socket != nullptr && ! socket->port->isChoice())
            return { node->id, filled (TRANS ("%1: %2. Drag to the right or up; hold Shift for fine steps"), nameOf (*socket->port), socket->port->about),
                     juce::MouseCursor::UpDownLeftRightResizeCursor };
        if (node->face->type == nullptr) return { node->id, node->type };
        return { node->id, std::string (node->face->type->info.name) + ": " + std::string (node->face->type->info.summary) };
    }
    if (const auto bend = bendAt (at, false)) return overBend (*bend);
    if (wire != nullptr)
        return { wire->id, filled (TRANS ("%1. Double-click inserts a node; Alt+drag bends the wire"), wire->text) };
    const auto note = shown->noteAt (at);
    if (! note) return {};
    const auto shape = shown->isCorner (*note, at) ? juce::MouseCursor::BottomRightCornerResizeCursor : juce::MouseCursor::NormalCursor;
    return { 0, TRANS ("Note: drag to move, drag the corner to resize, double-click to edit"), shape };
}

juce::String Canvas::tooltipAt (juce::Point<float> pixel) const
{
    constexpr float reach = 4.0f;   // pixels
    const auto at = window.toCanvas (pixel);
    for (const auto& [id, limit] : highlights.live.limits)
        if (const auto* node = shown->find (id); node != nullptr && limitLightOf (*node, window.zoom).expanded (reach / window.zoom).contains (at))
            return fromUtf8 (limit.text);
    if (highlights.live.runs) return {};   // a card shows what the port carries
    if (const auto s = shown->socketAt (at, socket_reach / window.zoom)) return portText (*s.node, *s.socket->port);
    const auto* node = shown->nodeAt (at);
    const auto* socket = node == nullptr ? nullptr : socketOf (*node, at);
    return socket == nullptr ? juce::String() : portText (*node, *socket->port);
}

void Canvas::mouseMove (const juce::MouseEvent& e)
{
    const auto at = window.toCanvas (e.position);
    const auto* wire = wireUnder (at);   // one look for both: a large patch has thousands
    point (portAt (at, wire));
    auto over = hoverAt (at, wire);
    const auto& problems = highlights.live.problems;
    if (const auto problem = problems.find (over.id); problem != problems.end()) over.text = problem->second;
    setMouseCursor (over.cursor);
    hint (over.text);
    if (over.id == highlights.hovered) return;
    highlights.hovered = over.id;
    repaint();
}

void Canvas::mouseExit (const juce::MouseEvent&)
{
    highlights.hovered = 0;
    point ({});
    hint ({});
    repaint();
}

/// A port is pointed at by its socket or by its label. A wire shows what its source carries.
PointedPort Canvas::portAt (juce::Point<float> at, const SceneWire* wire) const
{
    using Side = PointedPort::Side;
    const auto found = shown->socketAt (at, socket_reach / window.zoom);
    const auto* node = found ? found.node : shown->nodeAt (at);
    if (node == nullptr)
        return wire == nullptr ? PointedPort {} : PointedPort { address (wire->source), at, Side::below };
    const auto* socket = found ? found.socket : socketOf (*node, at);
    if (socket == nullptr || socket->port->isChoice() || node->face->kind == Face::Kind::placeholder) return {};
    if (const auto& port = *socket->port; port.role == Role::param)   // the value of an unwired param is in its row
    {
        const auto drives = [&] (const SceneWire& w) {
            return w.in_role == Role::param && w.in == port.id && &shown->nodes()[static_cast<std::size_t> (w.end)] == node;
        };
        if (std::ranges::none_of (shown->wires(), drives)) return {};
    }
    const bool is_output = socket->port->role == Role::output;
    const juce::Point<float> edge { is_output ? node->bounds().getRight() : node->at.x, node->at.y + socket->at.y };
    return { address (node->name + '.' + socket->port->id), edge, is_output ? Side::right : Side::left };
}

/// The card of a wire stays where it appeared while the pointer moves along the wire.
void Canvas::point (PointedPort now)
{
    if (now.port == pointed_at.port && now.side == pointed_at.side) return;
    pointed_at = std::move (now);
}

void Canvas::showLive (LiveState live)
{
    if (live == highlights.live) return;
    const auto before = std::exchange (highlights.live, std::move (live));
    repaintChanged (before);
}

void Canvas::repaintAround (juce::Rectangle<float> area)
{
    constexpr float glow = 8.0f;
    repaint (area.expanded (glow).transformedBy (window.transform()).getSmallestIntegerContainer());
}

/// Lamps, wires, driven params and the card change many times a second while a graph runs, so only they are painted again if nothing else has changed.
void Canvas::repaintChanged (const LiveState& before)
{
    const auto& now = highlights.live;
    if (now.costs != before.costs || now.problems != before.problems || now.limits != before.limits) return repaint();
    const auto differs = [] (const auto& a, const auto& b, graph::Id id) {
        const auto at_a = a.find (id), at_b = b.find (id);
        return (at_a == a.end()) != (at_b == b.end()) || (at_a != a.end() && at_a->second != at_b->second);
    };
    if (now.states != before.states)
        for (const auto& n : shown->nodes())
            if (differs (now.states, before.states, n.id)) repaintAround (n.bounds().withHeight (Box::header_height));
    for (const auto& w : shown->wires())
        if (differs (now.levels, before.levels, w.id) || differs (now.hits, before.hits, w.id)) repaintAround (w.path().getBounds());
    for (const auto& [first, second] : { std::pair (&now, &before), std::pair (&before, &now) })
        for (const auto& [of, text] : first->driven)
        {
            const auto other = second->driven.find (of);
            const auto* node = other != second->driven.end() && other->second == text ? nullptr : shown->find (of.first);
            if (const auto* socket = node == nullptr ? nullptr : node->box.find (Role::param, of.second)) repaintAround (socket->row + node->at);
        }
    for (const auto* card : { &now.card, &before.card })
        if (*card && now.card != before.card) repaint (boundsOf (**card, window.toPixels ((*card)->where.at), getLocalBounds()).expanded (4));
}

}   // namespace tactus::host
