// SPDX-License-Identifier: GPL-3.0-or-later
#include "drags.hpp"

#include <framework/graph/endpoints.hpp>
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
    Move (Canvas& c, const juce::MouseEvent& e) : canvas (c), grabbed (c.view().toCanvas (e.position))
    {
        for (const auto& n : c.scene().nodes())
            if (c.selection().contains (n.id)) starts.emplace_back (n.id, n.at);
        // A scene that arranges itself would move the others too, once one of them has a place of its own.
        for (const auto& n : c.scene().nodes())
            if (! c.selection().contains (n.id)) others.emplace_back (n.id, n.at);
    }

    void move (const juce::MouseEvent& e) override
    {
        auto way = canvas.view().toCanvas (e.position) - grabbed;
        if (! e.mods.isAltDown()) way = { std::round (way.x / Box::grid) * Box::grid, std::round (way.y / Box::grid) * Box::grid };
        if (way == moved) return;
        moved = way;
        auto places = begun ? std::vector<std::pair<graph::Id, juce::Point<float>>> {} : others;
        for (const auto& [id, at] : starts)
            places.emplace_back (id, at + way);
        auto& document = canvas.edited();
        document.perform (placeNodes (document.graph(), canvas.patch(), places), begun ? graph::Step::joined : graph::Step::own);
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
        const auto* wire = scene.wireAt (node->bounds().getCentre(), node->bounds().getHeight() / 2);
        if (wire == nullptr) return;
        if (auto command = insertInto (canvas.edited().graph(), canvas.patch(), scene, wire->id, node->id))
            canvas.edited().perform (std::move (*command), graph::Step::joined);
    }

private:
    Canvas& canvas;
    juce::Point<float> grabbed, moved;
    std::vector<std::pair<graph::Id, juce::Point<float>>> starts, others;
    bool begun = false;
};

class DrawWire final : public Drag
{
public:
    DrawWire (Canvas& c, WireStart s) : canvas (c), start (std::move (s))
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
            canvas.hint (problem ? juce::String (over.node->name + "." + over.socket->port->id + ": " + *problem) : juce::String (over.node->name + "." + over.socket->port->id));
            if (! problem) end_at = over.node->placeOf (*over.socket);
        }
        else
            canvas.hint ("Let go on a port that is lit, or on the canvas for a new node");
        canvas.repaint();
    }

    void end (const juce::MouseEvent& e) override
    {
        canvas.hint ({});
        const auto at = canvas.view().toCanvas (e.position);
        const auto over = canvas.scene().socketAt (at, reach_px / canvas.view().zoom);
        const auto* node = canvas.scene().find (start.node);
        const auto* port = node == nullptr ? nullptr : node->face->find (start.role, start.port);
        if (port == nullptr) return;
        if (over)
        {
            if (problemAt (*over.node, *over.socket->port)) return;
            auto& document = canvas.edited();
            document.perform (start.role == Role::output ? connect (document.graph(), canvas.patch(), *node, *port, *over.node, *over.socket->port)
                                                         : connect (document.graph(), canvas.patch(), *over.node, *over.socket->port, *node, *port));
        }
        else if (canvas.scene().nodeAt (at) == nullptr && e.getDistanceFromDragStart() > 8)
            canvas.wantNode (at, start);
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
        paintWire (g, wire, themeOf (canvas), false, false);
    }

private:
    std::optional<std::string> problemAt (const SceneNode& n, const FacePort& p) const
    {
        const auto* node = canvas.scene().find (start.node);
        const auto* port = node == nullptr ? nullptr : node->face->find (start.role, start.port);
        if (port == nullptr) return "gone";
        const WireEnd here { port, node->quantityOf (*port) }, there { &p, n.quantityOf (p) };
        return start.role == Role::output ? whyNot (here, there) : whyNot (there, here);
    }

    Canvas& canvas;
    WireStart start;
    juce::Point<float> begin, end_at;
};
}   // namespace

std::unique_ptr<Drag> panBy (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Pan> (c, e); }
std::unique_ptr<Drag> lasso (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Lasso> (c, e); }
std::unique_ptr<Drag> moveSelection (Canvas& c, const juce::MouseEvent& e) { return std::make_unique<Move> (c, e); }
std::unique_ptr<Drag> drawWire (Canvas& c, WireStart s) { return std::make_unique<DrawWire> (c, std::move (s)); }

}   // namespace tactus::host
