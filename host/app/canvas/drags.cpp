// SPDX-License-Identifier: GPL-3.0-or-later
#include "drags.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/model/drag_number.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/wire_rules.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/endpoints.hpp>
#include <tactus/run/turn.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr float reach_px = 14.0f;   // how far from the centre of a port a wire may be dropped

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
        const auto isCarried = [&] (const SceneNode& n) {
            for (std::size_t i = 0; i < notes.size(); ++i)
                if (notes[i].isRegion() && c.selection().contains (noteId (i)) && notes[i].area.contains (n.bounds())) return true;
            return false;
        };
        for (const auto& n : c.scene().nodes())
            if (c.selection().contains (n.id) || isCarried (n)) starts.emplace_back (n.id, n.at);
    }

    void move (const juce::MouseEvent& e) override
    {
        auto by = canvas.view().toCanvas (e.position) - grabbed;
        if (! e.mods.isAltDown()) by = (by / Box::grid).roundToInt().toFloat() * Box::grid;
        if (by == moved) return;
        moved = by;
        graph::Batch all { NEEDS_TRANS ("move"), {} };
        auto places = starts;
        for (auto& [id, at] : places)
            at += by;
        const auto& document = canvas.edited();
        if (! places.empty()) all.commands.push_back (placeNodes (document.graph(), canvas.patch(), places));
        auto now = notes;
        bool with_notes = false;
        for (std::size_t i = 0; i < now.size(); ++i)
            if (canvas.selection().contains (noteId (i)))
            {
                now[i].area += by;
                with_notes = true;
            }
        if (with_notes) all.commands.push_back (setNotes (document.graph(), canvas.patch(), now, NEEDS_TRANS ("move")));
        canvas.commands().perform (std::move (all), begun ? graph::Step::joined : graph::Step::own);
        begun = true;
    }

    void end (const juce::MouseEvent&) override
    {
        if (! begun || starts.size() != 1) return;
        const auto& scene = canvas.scene();
        const auto* node = scene.find (starts[0].first);
        if (node == nullptr) return;
        for (const auto& w : scene.wires())
            for (const int end : { w.start, w.end })
                if (&scene.nodes()[static_cast<std::size_t> (end)] == node) return;
        for (const auto* wire : scene.wiresAt (node->bounds().getCentre(), node->bounds().getHeight() / 2))
            if (auto command = insertInto (canvas.edited().graph(), canvas.patch(), scene, wire->id, node->id))
            {
                canvas.commands().perform (std::move (*command), graph::Step::joined);
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
    ResizeNote (Canvas& c, const juce::MouseEvent& e, std::size_t n)
        : canvas (c), grabbed (c.view().toCanvas (e.position)), note (n), notes (c.scene().notes())
    {
    }

    void move (const juce::MouseEvent& e) override
    {
        constexpr float least = 6 * Box::grid;
        const auto by = canvas.view().toCanvas (e.position) - grabbed;
        auto now = notes;
        now[note].area.setSize (std::max (least, notes[note].area.getWidth() + by.x), std::max (least, notes[note].area.getHeight() + by.y));
        const auto step = begun ? graph::Step::joined : graph::Step::own;
        canvas.commands().perform (setNotes (canvas.edited().graph(), canvas.patch(), now, NEEDS_TRANS ("resize note")), step);
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
    Minimap map;   // the map at the start of the drag, so that it does not move under the pointer
};

class DragParam final : public Drag
{
public:
    DragParam (Canvas& c, const SceneNode& n, const FacePort& p, QuantityText v)
        : canvas (c), id { n.id, Role::param, p.id }, sheet (*p.sheet), grabbed (v), now (v)
    {
        if (c.patch().empty()) control = controlOf (c.edited().graph(), n.name + '.' + p.id);
    }

    void move (const juce::MouseEvent& e) override
    {
        constexpr double fine = 0.1;
        const double up = -static_cast<double> (e.getDistanceFromDragStartY());
        auto to = dragged (grabbed, sheet, e.mods.isShiftDown() ? up * fine : up);
        if (control)
        {
            const auto [low, high] = std::minmax (control->low, control->high);
            to = to.moved (std::clamp (to.si(), low, high));
        }
        const auto param = canvas.scene().findPort (id);
        if (to.number == now.number || ! param || ! sheet.limits.hard.contains (to.si())) return;
        now = to;
        canvas.commands().setParam (*param.node, *param.port, to.toJson(), begun ? graph::Step::joined : graph::Step::own);
        begun = true;
    }

private:
    Canvas& canvas;
    PortId id;
    const PortSheet& sheet;
    std::optional<ControlledParam> control;   // set if a control drives the param; it limits the range
    QuantityText grabbed, now;
    bool begun = false;
};

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
        const auto over = targetAt (end_at);
        if (over && over.node->id != start.node)
        {
            const auto fits = check (*over.node, *over.socket->port);
            problem = fits ? juce::String() : fromUtf8 (fits.error().text);
            canvas.hint (juce::String (over.node->name + "." + over.socket->port->id) + (fits ? juce::String() : ": " + problem));
            if (fits) end_at = over.node->placeOf (*over.socket);
        }
        else
        {
            problem.clear();
            canvas.hint (TRANS ("Drop on a highlighted port, or on the canvas to add a node"));
        }
        canvas.repaint();
    }

    void end (const juce::MouseEvent& e) override
    {
        canvas.hint ({});
        const auto at = canvas.view().toCanvas (e.position);
        const auto over = targetAt (at);
        if (! over)
        {
            if (e.getDistanceFromDragStart() <= least_drag_px || canvas.scene().nodeAt (at) != nullptr) return;
            if (wire_id != 0) return unplug (NEEDS_TRANS ("disconnect"));
            canvas.commands().requestNode ({ at, start });
            return;
        }
        if (! check (*over.node, *over.socket->port)) return;
        const PortId other { over.node->id, over.socket->port->role, over.socket->port->id };
        if (wire_id != 0) unplug (NEEDS_TRANS ("re-plug wire"));   // rebuilds the scene
        const auto a = canvas.scene().findPort (start), b = canvas.scene().findPort (other);
        if (a && b) start.role == Role::output ? canvas.commands().join (a, b) : canvas.commands().join (b, a);
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
        const WireEnd there { &p, n.quantityOf (p) };
        return start.role == Role::output ? checkWireByComponent (from.end(), there) : checkWireByComponent (there, from.end());
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

    void unplug (const char* step) { canvas.commands().perform (graph::Batch { step, { graph::RemoveWire { canvas.patch(), wire_id } } }); }

    static constexpr int least_drag_px = 8;

    Canvas& canvas;
    PortId start;
    graph::Id wire_id;
    juce::Point<float> begin, end_at;
    juce::String problem;   // why the wire cannot end at the current port
};
}   // namespace

std::unique_ptr<Drag> panBy (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Pan> (c, e); }
std::unique_ptr<Drag> lasso (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Lasso> (c, e); }
std::unique_ptr<Drag> moveSelection (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Move> (c, e); }
std::unique_ptr<Drag> drawWire (Canvas& c, PortId s) { return std::make_unique<DrawWire> (c, std::move (s)); }
std::unique_ptr<Drag> resizeNote (Canvas& c, const juce::MouseEvent& e, std::size_t note) { return std::make_unique<ResizeNote> (c, e, note); }
std::unique_ptr<Drag> panByMap (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<PanByMap> (c, e); }

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

std::unique_ptr<Drag> dragParam (Canvas& c, const SceneNode& node, const Socket& socket)
{
    const auto* sheet = socket.port->sheet;
    if (sheet == nullptr || socket.port->width != 1 || socket.port->isChoice()) return nullptr;
    const auto value = readQuantity (readValue (socket.value), *sheet);
    return value ? std::make_unique<DragParam> (c, node, *socket.port, *value) : nullptr;
}

}   // namespace tactus::host
