// SPDX-License-Identifier: GPL-3.0-or-later
// The drag that draws a wire, or moves one to another end.
#include "drags.hpp"
#include "paint/paint_wires.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/wire_rules.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr float reach_px = 14.0f;   // how far from the centre of a port a wire may be dropped

class DrawWire final : public Drag
{
public:
    /// `replugged` is the existing wire being moved to another end; 0 for a new wire.
    DrawWire (Canvas& c, PortId s, graph::Id replugged = 0) : canvas (c), start (std::move (s)), wire_id (replugged)
    {
        const auto* node = c.scene().find (start.node);
        const auto* socket = node == nullptr ? nullptr : node->box.find (start.role, start.port);
        if (socket == nullptr) return;
        begin = end_at = node->placeOf (*socket);
        c.highlighted().fits = [this] (const SceneNode& n, const FacePort& p) { return check (n, p).has_value(); };
    }

    ~DrawWire() override
    {
        canvas.highlighted().fits = nullptr;
        canvas.repaint();
    }

    void move (const juce::MouseEvent& e) override
    {
        end_at = canvas.view().toCanvas (e.position);
        const auto over = isOutside (e) ? SceneSocket {} : targetAt (end_at);
        if (over && over.node->id != start.node)
        {
            const auto fits = check (*over.node, *over.socket->port);
            problem = fits ? juce::String() : fromUtf8 (fits.error().text);
            canvas.hint (named (over) + (fits ? juce::String() : ": " + problem));
            if (fits) end_at = over.node->placeOf (*over.socket);
        }
        else
        {
            problem.clear();
            canvas.hint (isOutside (e) ? TRANS ("Drop on a knob to modulate what it sets")
                                       : TRANS ("Drop on a highlighted port, or on the canvas to add a node"));
        }
        canvas.repaint();
    }

    void end (const juce::MouseEvent& e) override
    {
        canvas.hint ({});
        const auto at = canvas.view().toCanvas (e.position);
        if (isOutside (e))
        {
            if (wire_id == 0) canvas.onWireOutside (start, e.getScreenPosition());   // an existing wire stays where it was
            return;
        }
        const auto over = targetAt (at);
        if (! over)
        {
            if (e.getDistanceFromDragStart() <= least_drag_px || canvas.scene().nodeAt (at) != nullptr) return;
            if (wire_id != 0) return unplug();
            canvas.commands().requestNode ({ at, start });
            return;
        }
        if (const auto fits = check (*over.node, *over.socket->port); ! fits)
        {
            if (e.getDistanceFromDragStart() > least_drag_px) canvas.notice (named (over) + ": " + fromUtf8 (fits.error().text));
            return;
        }
        const PortId other { over.node->id, over.socket->port->role, over.socket->port->id };
        const auto a = canvas.scene().findPort (start), b = canvas.scene().findPort (other);
        if (! a || ! b) return;
        start.role == Role::output ? canvas.commands().join (a, b, wire_id) : canvas.commands().join (b, a, wire_id);
    }

    void paint (juce::Graphics& g) const override
    {
        const auto from = canvas.scene().findPort (start);
        if (! from) return;
        SceneWire wire;
        wire.from = start.role == Role::output ? begin : end_at;
        wire.to = start.role == Role::output ? end_at : begin;
        wire.quantity = from.end().quantity;
        wire.width = from.port->width;
        const juce::Graphics::ScopedSaveState state (g);
        g.addTransform (canvas.view().transform());
        wire.enabled = problem.isEmpty();
        paintWire (g, wire, themeOf (canvas), false, false);
        if (problem.isNotEmpty()) paintProblem (g);
    }

private:
    /// True if the pointer is beside the canvas, where another part of the window may take the wire. Nodes that are hidden there are no targets.
    bool isOutside (const juce::MouseEvent& e) const { return canvas.onWireOutside && ! canvas.getLocalBounds().contains (e.getPosition()); }

    /// The port at a place; elsewhere on a node, the first one that fits, preferably one that has no wire yet.
    SceneSocket targetAt (juce::Point<float> at) const
    {
        const auto& scene = canvas.scene();
        if (const auto over = scene.socketAt (at, reach_px / canvas.view().zoom)) return over;
        const auto* node = scene.nodeAt (at);
        if (node == nullptr || node->id == start.node) return {};
        const auto from = scene.findPort (start);
        const auto isTaken = [&] (const Socket& s) {
            return std::ranges::any_of (scene.wires(), [&] (const SceneWire& w) {
                return s.port->role == Role::input && w.in == s.port->id && w.end >= 0 && scene.nodes()[static_cast<std::size_t> (w.end)].id == node->id;
            });
        };
        const auto wanted = start.role == Role::output ? Role::input : Role::output;
        SceneSocket found;
        for (const auto& s : node->box.sockets)
            if (from && s.port->role == wanted && s.port->width == from.port->width && check (*node, *s.port))
            {
                if (! isTaken (s)) return { node, &s };
                if (! found) found = { node, &s };
            }
        return found;
    }

    Result<> check (const SceneNode& n, const FacePort& p) const
    {
        const auto from = canvas.scene().findPort (start);
        if (! from) return Message::error ("wire/refused", {}, TRANS ("the port no longer exists").toStdString());
        const ScenePort there { &n, &p };
        return start.role == Role::output ? canvas.commands().mayJoin (from, there, wire_id) : canvas.commands().mayJoin (there, from, wire_id);
    }

    /// Paints the problem next to the end of the wire, above the pointer.
    void paintProblem (juce::Graphics& g) const
    {
        const auto& look = lookOf (canvas);
        const auto font = look.font (13.0f, true);
        const auto box = juce::Rectangle<float> (font.getStringWidthFloat (problem) + 20.0f, 24.0f).withPosition (end_at.translated (14.0f, -34.0f));
        g.setColour (look.theme().panel);
        g.fillRoundedRectangle (box, 4.0f);
        g.setColour (look.theme().warning);
        g.drawRoundedRectangle (box.reduced (0.5f), 4.0f, 1.2f);
        g.setFont (font);
        g.setColour (look.theme().text);
        g.drawText (problem, box, juce::Justification::centred, false);
    }

    static juce::String named (const SceneSocket& s) { return fromUtf8 (s.node->name + "." + s.socket->port->id); }
    void unplug() { canvas.commands().perform (graph::Batch { NEEDS_TRANS ("disconnect"), { graph::RemoveWire { canvas.patch(), wire_id } } }); }

    static constexpr int least_drag_px = 8;

    Canvas& canvas;
    PortId start;
    graph::Id wire_id;
    juce::Point<float> begin, end_at;
    juce::String problem;   // why the wire cannot end at the current port
};
}   // namespace

std::unique_ptr<Drag> drawWire (Canvas& c, PortId s) { return std::make_unique<DrawWire> (c, std::move (s)); }

std::unique_ptr<Drag> replugWire (Canvas& c, const SceneNode& node, const FacePort& port)
{
    const auto* patch = findPatch (c.edited().graph(), c.patch());
    if (patch == nullptr) return nullptr;
    for (const auto& w : patch->wires)
    {
        if (w.to.node != node.name || node.face->endOf (w.to) != &port) continue;
        const auto start = std::ranges::find (c.scene().nodes(), w.from.node, &SceneNode::name);
        const auto* out = start == c.scene().nodes().end() ? nullptr : start->face->startOf (w.from);
        if (out != nullptr) return std::make_unique<DrawWire> (c, PortId { start->id, Role::output, out->id }, w.id);
    }
    return nullptr;
}

}   // namespace tactus::host
