// SPDX-License-Identifier: GPL-3.0-or-later
#include "drags.hpp"

#include <framework/graph/endpoints.hpp>
#include <framework/turn.hpp>
#include <host/app/model/drag_number.hpp>
#include <host/app/model/held.hpp>
#include <host/app/model/wire_rules.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr float reach_px = 14.0f;   // from the middle of a port

class Pan final : public Drag
{
public:
    Pan (Canvas& c, const juce::MouseEvent& e) : canvas (c), origin (c.view().origin), grabbed (e.position) {}

    void move (const juce::MouseEvent& e) override
    {
        canvas.view().origin = origin + (e.position - grabbed);
        canvas.repaint();
    }

private:
    Canvas& canvas;
    juce::Point<float> origin, grabbed;
};

class Lasso final : public Drag
{
public:
    Lasso (Canvas& c, const juce::MouseEvent& e) : canvas (c), corner (c.view().toCanvas (e.position)), area (corner, corner)
    {
        if (e.mods.isShiftDown() || e.mods.isCommandDown()) before = c.selection();
        c.select (before);
    }

    void move (const juce::MouseEvent& e) override
    {
        area = { corner, canvas.view().toCanvas (e.position) };
        auto chosen = before;
        for (const auto& n : canvas.scene().nodes())
            if (n.bounds().intersects (area)) chosen.insert (n.id);
        canvas.select (std::move (chosen));
    }

    void end (const juce::MouseEvent&) override { canvas.repaint(); }

    void paint (juce::Graphics& g) const override
    {
        const auto& theme = themeOf (canvas);
        const juce::Rectangle<float> box { canvas.view().toPixels (area.getTopLeft()), canvas.view().toPixels (area.getBottomRight()) };
        g.setColour (theme.accent.withAlpha (0.12f));
        g.fillRect (box);
        g.setColour (theme.accent);
        g.drawRect (box, 1.0f);
    }

private:
    Canvas& canvas;
    juce::Point<float> corner;
    juce::Rectangle<float> area;
    Selection before;
};

class Move final : public Drag
{
public:
    Move (Canvas& c, const juce::MouseEvent& e) : canvas (c), grabbed (c.view().toCanvas (e.position)), notes (c.scene().notes())
    {
        const auto isCarried = [&] (const SceneNode& n)
        {
            for (std::size_t i = 0; i < notes.size(); ++i)
                if (notes[i].isRegion() && c.selection().contains (noteId (i)) && notes[i].area.contains (n.bounds())) return true;
            return false;
        };
        for (const auto& n : c.scene().nodes())
            if (c.selection().contains (n.id) || isCarried (n)) starts.emplace_back (n.id, n.at);
    }

    void move (const juce::MouseEvent& e) override
    {
        auto way = canvas.view().toCanvas (e.position) - grabbed;
        if (! e.mods.isAltDown()) way = { std::round (way.x / Box::grid) * Box::grid, std::round (way.y / Box::grid) * Box::grid };
        if (way == moved) return;
        moved = way;
        graph::Batch all { "move", {} };
        auto places = starts;
        for (auto& [id, at] : places)
            at += way;
        const auto& document = canvas.edited();
        if (! places.empty()) all.commands.push_back (placeNodes (document.graph(), canvas.patch(), places));
        auto now = notes;
        bool with_notes = false;
        for (std::size_t i = 0; i < now.size(); ++i)
            if (canvas.selection().contains (noteId (i)))
            {
                now[i].area += way;
                with_notes = true;
            }
        if (with_notes) all.commands.push_back (setNotes (document.graph(), canvas.patch(), now, "move"));
        canvas.perform (std::move (all), begun ? graph::Step::joined : graph::Step::own);
        begun = true;
    }

    void end (const juce::MouseEvent&) override
    {
        if (! begun || starts.size() != 1) return;
        const auto& scene = canvas.scene();
        const auto* node = scene.find (starts[0].first);
        if (node == nullptr) return;
        for (const auto& w : scene.wires())
            if (scene.nodes()[static_cast<std::size_t> (w.start)].id == node->id || scene.nodes()[static_cast<std::size_t> (w.end)].id == node->id) return;
        for (const auto* wire : scene.wiresAt (node->bounds().getCentre(), node->bounds().getHeight() / 2))
            if (auto command = insertInto (canvas.edited().graph(), canvas.patch(), scene, wire->id, node->id))
            {
                canvas.perform (std::move (*command), graph::Step::joined);
                return;
            }
    }

private:
    Canvas& canvas;
    juce::Point<float> grabbed, moved;
    std::vector<std::pair<graph::Id, juce::Point<float>>> starts;
    std::vector<Note> notes;
    bool begun = false;
};

class ResizeNote final : public Drag
{
public:
    ResizeNote (Canvas& c, const juce::MouseEvent& e, std::size_t n) : canvas (c), grabbed (c.view().toCanvas (e.position)), note (n), notes (c.scene().notes()) {}

    void move (const juce::MouseEvent& e) override
    {
        constexpr float least = 6 * Box::grid;
        const auto way = canvas.view().toCanvas (e.position) - grabbed;
        auto now = notes;
        now[note].area.setSize (std::max (least, notes[note].area.getWidth() + way.x), std::max (least, notes[note].area.getHeight() + way.y));
        canvas.perform (setNotes (canvas.edited().graph(), canvas.patch(), now, "resize a note"), begun ? graph::Step::joined : graph::Step::own);
        begun = true;
    }

private:
    Canvas& canvas;
    juce::Point<float> grabbed;
    std::size_t note;
    std::vector<Note> notes;
    bool begun = false;
};

class PanByMap final : public Drag
{
public:
    PanByMap (Canvas& c, const juce::MouseEvent& e) : canvas (c), map (c.scene(), c.view(), c.getLocalBounds()) { move (e); }

    void move (const juce::MouseEvent& e) override
    {
        canvas.view().centreOn (map.toCanvas (e.position), canvas.getLocalBounds().toFloat());
        canvas.repaint();
    }

private:
    Canvas& canvas;
    Minimap map;   // as it was when it was grabbed, so that it does not move under the pointer
};

class TurnParam final : public Drag
{
public:
    TurnParam (Canvas& c, const SceneNode& n, const FacePort& p, QuantityText v)
        : canvas (c), node (n.id), port (p.id), sheet (*p.sheet), held (c.patch().empty() ? heldBy (c.edited().graph(), n.name + '.' + p.id) : std::nullopt), grabbed (v), now (v)
    {
    }

    void move (const juce::MouseEvent& e) override
    {
        constexpr double fine = 0.1;
        auto to = dragged (grabbed, sheet, -static_cast<double> (e.getDistanceFromDragStartY()) * (e.mods.isShiftDown() ? fine : 1.0));
        if (held) to = to.moved (std::clamp (to.si(), std::min (held->low, held->high), std::max (held->low, held->high)));
        const auto* shown = canvas.scene().find (node);
        const auto* p = shown == nullptr ? nullptr : shown->face->find (Role::param, port);
        if (to.number == now.number || p == nullptr || ! sheet.limits.hard.contains (to.si())) return;
        now = to;
        canvas.setParam (*shown, *p, to.toJson(), begun ? graph::Step::joined : graph::Step::own);
        begun = true;
    }

private:
    Canvas& canvas;
    graph::Id node;
    std::string port;
    const PortSheet& sheet;
    std::optional<Held> held;   // a control moves it, and only so far
    QuantityText grabbed, now;
    bool begun = false;
};

class DrawWire final : public Drag
{
public:
    /// `replugged` is a wire that is taken to another end; 0 if it is a new one.
    DrawWire (Canvas& c, WireStart s, graph::Id replugged = 0) : canvas (c), start (std::move (s)), wire_id (replugged)
    {
        const auto* node = c.scene().find (start.node);
        const auto* socket = node == nullptr ? nullptr : node->box.find (start.role, start.port);
        if (socket == nullptr) return;
        begin = end_at = node->placeOf (*socket);
        c.lit().fits = [this] (const SceneNode& n, const FacePort& p)
        { return ! problemAt (n, p); };
    }

    ~DrawWire() override
    {
        canvas.lit().fits = nullptr;
        canvas.repaint();
    }

    void move (const juce::MouseEvent& e) override
    {
        end_at = canvas.view().toCanvas (e.position);
        const auto over = canvas.scene().socketAt (end_at, reach_px / canvas.view().zoom);
        if (over && over.node->id != start.node)
        {
            const auto problem = problemAt (*over.node, *over.socket->port);
            why_not = problem ? juce::String (*problem) : juce::String();
            canvas.hint (problem ? juce::String (over.node->name + "." + over.socket->port->id + ": " + *problem) : juce::String (over.node->name + "." + over.socket->port->id));
            if (! problem) end_at = over.node->placeOf (*over.socket);
        }
        else
        {
            why_not.clear();
            canvas.hint ("Let go on a port that is lit, or on the canvas for a new node");
        }
        canvas.repaint();
    }

    void end (const juce::MouseEvent& e) override
    {
        canvas.hint ({});
        const auto at = canvas.view().toCanvas (e.position);
        const auto over = canvas.scene().socketAt (at, reach_px / canvas.view().zoom);
        if (! over)
        {
            if (e.getDistanceFromDragStart() <= least_way_px || canvas.scene().nodeAt (at) != nullptr) return;
            if (wire_id != 0) return unplug ("disconnect");
            canvas.wantNode ({ at, start });
            return;
        }
        if (problemAt (*over.node, *over.socket->port)) return;
        const auto* node = canvas.scene().find (start.node);
        const auto* port = node == nullptr ? nullptr : node->face->find (start.role, start.port);
        if (port == nullptr) return;
        const WireStart other { over.node->id, over.socket->port->role, over.socket->port->id };
        if (wire_id != 0)
        {
            unplug ("re-plug");
            // The scene is another one now.
            node = canvas.scene().find (start.node);
            port = node == nullptr ? nullptr : node->face->find (start.role, start.port);
        }
        const auto* there = canvas.scene().find (other.node);
        const auto* in = there == nullptr ? nullptr : there->face->find (other.role, other.port);
        if (port == nullptr || in == nullptr) return;
        start.role == Role::output ? canvas.join (*node, *port, *there, *in) : canvas.join (*there, *in, *node, *port);
    }

    void paint (juce::Graphics& g) const override
    {
        const auto* node = canvas.scene().find (start.node);
        const auto* port = node == nullptr ? nullptr : node->face->find (start.role, start.port);
        if (port == nullptr) return;
        SceneWire wire;
        wire.from = start.role == Role::output ? begin : end_at;
        wire.to = start.role == Role::output ? end_at : begin;
        wire.quantity = node->quantityOf (*port);
        wire.width = port->width;
        const juce::Graphics::ScopedSaveState state (g);
        g.addTransform (canvas.view().transform());
        wire.enabled = why_not.isEmpty();
        paintWire (g, wire, themeOf (canvas), false, false);
        if (why_not.isNotEmpty()) paintWhyNot (g);
    }

private:
    std::optional<std::string> problemAt (const SceneNode& n, const FacePort& p) const
    {
        const auto* node = canvas.scene().find (start.node);
        const auto* port = node == nullptr ? nullptr : node->face->find (start.role, start.port);
        if (port == nullptr) return "gone";
        const WireEnd here { port, node->quantityOf (*port) }, there { &p, n.quantityOf (p) };
        return start.role == Role::output ? whyNotByComponent (here, there) : whyNotByComponent (there, here);
    }

    /// Beside the end of the wire, above where the pointer is.
    void paintWhyNot (juce::Graphics& g) const
    {
        const auto& look = lookOf (canvas);
        const auto font = look.font (13.0f, true);
        const auto box = juce::Rectangle<float> (font.getStringWidthFloat (why_not) + 20.0f, 24.0f).withPosition (end_at.translated (14.0f, -34.0f));
        g.setColour (look.theme().panel);
        g.fillRoundedRectangle (box, 4.0f);
        g.setColour (look.theme().warning);
        g.drawRoundedRectangle (box.reduced (0.5f), 4.0f, 1.2f);
        g.setFont (font);
        g.setColour (look.theme().text);
        g.drawText (why_not, box, juce::Justification::centred, false);
    }

    void unplug (const char* step) { canvas.perform (graph::Batch { step, { graph::RemoveWire { canvas.patch(), wire_id } } }); }

    static constexpr int least_way_px = 8;

    Canvas& canvas;
    WireStart start;
    graph::Id wire_id;
    juce::Point<float> begin, end_at;
    juce::String why_not;   // it cannot end where it is
};
}   // namespace

std::unique_ptr<Drag> panBy (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Pan> (c, e); }
std::unique_ptr<Drag> lasso (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Lasso> (c, e); }
std::unique_ptr<Drag> moveSelection (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Move> (c, e); }
std::unique_ptr<Drag> drawWire (Canvas& c, WireStart s) { return std::make_unique<DrawWire> (c, std::move (s)); }
std::unique_ptr<Drag> resizeNote (Canvas& c, const juce::MouseEvent& e, std::size_t note) { return std::make_unique<ResizeNote> (c, e, note); }
std::unique_ptr<Drag> panByMap (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<PanByMap> (c, e); }

std::unique_ptr<Drag> replugWire (Canvas& c, const SceneNode& node, const FacePort& port)
{
    const auto& g = c.edited().graph();
    const auto* patch = c.patch().empty() ? &g.root : g.find (c.patch());
    if (patch == nullptr) return nullptr;
    for (const auto& w : patch->wires)
    {
        if (w.to.node != node.name || node.face->endOf (w.to) != &port) continue;
        const auto start = std::ranges::find (c.scene().nodes(), w.from.node, &SceneNode::name);
        const auto* out = start == c.scene().nodes().end() ? nullptr : start->face->startOf (w.from);
        if (out != nullptr) return std::make_unique<DrawWire> (c, WireStart { start->id, Role::output, out->id }, w.id);
    }
    return nullptr;
}

std::unique_ptr<Drag> turnParam (Canvas& c, const SceneNode& node, const Socket& socket)
{
    const auto* sheet = socket.port->sheet;
    if (sheet == nullptr || socket.port->width != 1 || socket.port->isChoice()) return nullptr;
    const auto value = readQuantity (readValue (socket.value), *sheet);
    const auto* text = std::get_if<QuantityText> (&value);
    return text == nullptr ? nullptr : std::make_unique<TurnParam> (c, node, *socket.port, *text);
}

}   // namespace tactus::host
