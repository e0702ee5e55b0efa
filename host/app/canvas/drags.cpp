// SPDX-License-Identifier: GPL-3.0-or-later
#include "drags.hpp"

#include <host/app/look/drag_way.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/model/controlled_param.hpp>
#include <host/app/model/drag_number.hpp>
#include <host/app/model/patch.hpp>
#include <tactus/run/turn.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
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
        Selection nodes;
        for (const auto& n : c.scene().nodes())
            if (c.selection().contains (n.id) || isCarried (n)) nodes.insert (n.id);
        starts = movedParts (c.edited().graph(), c.patch(), c.scene(), nodes);
    }

    void move (const juce::MouseEvent& e) override
    {
        auto by = canvas.view().toCanvas (e.position) - grabbed;
        if (! e.mods.isAltDown()) by = (by / Box::grid).roundToInt().toFloat() * Box::grid;
        if (by == moved_by) return;
        moved_by = by;
        const auto& document = canvas.edited();
        auto all = moved (document.graph(), canvas.patch(), starts, by);
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
        if (! begun || starts.nodes.size() != 1) return;
        const auto& scene = canvas.scene();
        const auto* node = scene.find (starts.nodes[0].first);
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
    juce::Point<float> grabbed, moved_by;
    MovedParts starts;
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
    DragParam (Canvas& c, const SceneNode& n, const FacePort& p, const QuantityText& v)
        : canvas (c), id { n.id, Role::param, p.id }, sheet (*p.sheet), grabbed (v), now (v)
    {
        const auto* patch = findPatch (c.edited().graph(), c.patch());
        if (const auto* node = patch == nullptr ? nullptr : patch->find (n.name))
            sheet = sheetInUse (c.edited().graph(), *patch, *node, p, v.toJson(), c.types());
        if (const auto address = c.seen().address (n.name + '.' + p.id); ! address.empty()) control = controlOf (c.edited().graph(), address);
    }

    void move (const juce::MouseEvent& e) override
    {
        auto to = dragged (grabbed, sheet, way.to (e));
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
    PortSheet sheet;
    std::optional<ControlledParam> control;   // set if a control drives the param; it limits the range
    QuantityText grabbed, now;
    DragWay way;
    bool begun = false;
};
}   // namespace

std::unique_ptr<Drag> panBy (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Pan> (c, e); }
std::unique_ptr<Drag> lasso (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Lasso> (c, e); }
std::unique_ptr<Drag> moveSelection (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Move> (c, e); }
std::unique_ptr<Drag> resizeNote (Canvas& c, const juce::MouseEvent& e, std::size_t note) { return std::make_unique<ResizeNote> (c, e, note); }
std::unique_ptr<Drag> panByMap (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<PanByMap> (c, e); }

std::unique_ptr<Drag> dragParam (Canvas& c, const SceneNode& node, const Socket& socket)
{
    const auto* sheet = socket.port->sheet;
    if (sheet == nullptr || socket.port->width != 1 || socket.port->isChoice() || ! socket.driver.empty()) return nullptr;
    const auto value = readQuantity (readValue (socket.value), *sheet);
    return value ? std::make_unique<DragParam> (c, node, *socket.port, *value) : nullptr;
}

}   // namespace tactus::host
