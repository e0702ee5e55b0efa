// SPDX-License-Identifier: GPL-3.0-or-later
#include "canvas.hpp"
#include "drags.hpp"

#include <host/app/model/fragment.hpp>
#include <host/app/model/wire_rules.hpp>

namespace tactus::host
{

namespace
{
constexpr float socket_reach = 9.0f, wire_reach = 6.0f;   // pixels
}   // namespace

Canvas::Canvas (Document& d, const Catalogue& c) : document (d), catalogue (c)
{
    setWantsKeyboardFocus (true);
    setTitle ("Canvas");
    document.add (*this);
    rebuild();
}

Canvas::~Canvas() { document.remove (*this); }

void Canvas::documentChanged()
{
    // What was entered may be gone.
    while (! entered.empty() && document.graph().find (entered.back().second) == nullptr)
        entered.pop_back();
    rebuild();
    std::erase_if (highlights.selected, [this] (graph::Id id)
                   { return shown->find (id) == nullptr && shown->findWire (id) == nullptr; });
    if (onWay) onWay();
    if (onSelection) onSelection();
}

void Canvas::rebuild()
{
    const auto& look = lookOf (*this);
    shown = std::make_unique<Scene> (document.graph(), patch(), catalogue, [&look] (const std::string& text, float size, bool bold)
                                     { return look.font (size, bold).getStringWidthFloat (text); });
    repaint();
}

void Canvas::hint (const juce::String& text)
{
    if (onHint) onHint (text);
}

void Canvas::select (Selection s)
{
    highlights.selected = std::move (s);
    repaint();
    if (onSelection) onSelection();
}

void Canvas::leaveTo (std::size_t depth)
{
    if (depth >= entered.size()) return;
    entered.resize (depth);
    highlights = {};
    rebuild();
    frameAll();
    if (onWay) onWay();
    if (onSelection) onSelection();
}

void Canvas::enter (const SceneNode& node)
{
    if (! node.type.starts_with ("graph:") || document.graph().find (node.type.substr (6)) == nullptr) return;
    entered.emplace_back (node.name, node.type.substr (6));
    highlights = {};
    rebuild();
    frameAll();
    if (onWay) onWay();
    if (onSelection) onSelection();
}

void Canvas::frameAll()
{
    window.frame (shown->bounds(), getLocalBounds().toFloat());
    repaint();
}

void Canvas::frameSelection()
{
    juce::Rectangle<float> area;
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id)) area = area.isEmpty() ? n.bounds() : area.getUnion (n.bounds());
    window.frame (area.isEmpty() ? shown->bounds() : area, getLocalBounds().toFloat());
    repaint();
}

void Canvas::removeSelection()
{
    if (! highlights.selected.empty()) document.perform (removeSelected (document.graph(), patch(), *shown, highlights.selected));
}

void Canvas::duplicateSelection()
{
    Selection made;
    auto command = paste (document.graph(), patch(), copyText (document.graph(), patch(), highlights.selected), 32.0, 32.0, made);
    if (made.empty() || std::holds_alternative<Message> (command)) return;
    std::get<graph::Batch> (std::get<graph::Command> (command).edit).name = "duplicate";
    if (document.perform (std::get<graph::Command> (std::move (command)))) select (made);
}

void Canvas::copySelection() const
{
    if (! highlights.selected.empty()) juce::SystemClipboard::copyTextToClipboard (copyText (document.graph(), patch(), highlights.selected));
}

void Canvas::pasteText()
{
    Selection made;
    auto command = paste (document.graph(), patch(), juce::SystemClipboard::getTextFromClipboard().toStdString(), 32.0, 32.0, made);
    if (const auto* problem = std::get_if<Message> (&command))
        hint ("Nothing to paste: " + juce::String (problem->text));
    else if (! made.empty() && document.perform (std::get<graph::Command> (std::move (command))))
        select (made);
}

void Canvas::addNodeAt (const std::string& type, juce::Point<float> at, const std::optional<WireStart>& start)
{
    graph::Id made = 0;
    if (! document.perform (addNode (document.graph(), patch(), type, at, made))) return;
    select ({ made });
    const auto *node = shown->find (made), *other = start ? shown->find (start->node) : nullptr;
    const auto* port = other == nullptr ? nullptr : other->face->find (start->role, start->port);
    if (port == nullptr || node == nullptr) return;

    const WireEnd there { port, other->quantityOf (*port) };
    const auto& ports = start->role == Role::output ? node->face->inputs : node->face->outputs;
    for (const auto& p : ports)
    {
        const WireEnd here { &p, node->quantityOf (p) };
        if (start->role == Role::output ? whyNot (there, here) : whyNot (here, there)) continue;
        document.perform (start->role == Role::output ? connect (document.graph(), patch(), *other, *port, *node, p) : connect (document.graph(), patch(), *node, p, *other, *port), graph::Step::joined);
        return;
    }
}

void Canvas::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    paintGrid (g, window, g.getClipBounds(), look.theme());
    if (shown->nodes().empty())
    {
        g.setColour (look.theme().dim);
        g.setFont (look.font (14.0f));
        g.drawText ("Nothing here yet. Press space, or double click, for the first node.", getLocalBounds(), juce::Justification::centred, true);
    }
    paintScene (g, *shown, window, look, highlights);
    if (drag) drag->paint (g);
}

void Canvas::resized()
{
    if (framed || getWidth() < 50 || getHeight() < 50) return;
    framed = true;
    frameAll();
}

std::unique_ptr<Drag> Canvas::dragFor (const juce::MouseEvent& e)
{
    if (e.mods.isMiddleButtonDown() || e.mods.isRightButtonDown()) return panBy (*this, e);
    const auto at = window.toCanvas (e.position);
    if (const auto over = shown->socketAt (at, socket_reach / window.zoom); over && ! over.socket->port->isChoice())
        return drawWire (*this, { over.node->id, over.socket->port->role, over.socket->port->id });

    const bool add = e.mods.isShiftDown() || e.mods.isCommandDown();
    if (const auto* node = shown->nodeAt (at))
    {
        if (add)
        {
            auto chosen = highlights.selected;
            if (! chosen.insert (node->id).second) chosen.erase (node->id);
            select (std::move (chosen));
        }
        else if (! highlights.selected.contains (node->id))
            select ({ node->id });
        return moveSelection (*this, e);
    }
    if (const auto* wire = shown->wireAt (at, wire_reach / window.zoom))
    {
        auto chosen = add ? highlights.selected : Selection {};
        chosen.insert (wire->id);
        select (std::move (chosen));
        return nullptr;
    }
    return lasso (*this, e);
}

void Canvas::mouseDown (const juce::MouseEvent& e)
{
    grabKeyboardFocus();
    drag = dragFor (e);
}

void Canvas::mouseDrag (const juce::MouseEvent& e)
{
    if (drag) drag->move (e);
}

void Canvas::mouseUp (const juce::MouseEvent& e)
{
    if (const auto ended = std::exchange (drag, nullptr)) ended->end (e);
    repaint();
}

void Canvas::mouseMove (const juce::MouseEvent& e)
{
    const auto at = window.toCanvas (e.position);
    graph::Id over = 0;
    juce::String text;
    if (const auto s = shown->socketAt (at, socket_reach / window.zoom))
    {
        const auto unit = s.socket->port->unit.kind == UnitRule::Kind::fixed ? s.socket->port->unit.unit : unitOf (s.node->quantityOf (*s.socket->port));
        over = s.node->id;
        text = s.node->name + "." + s.socket->port->id + "  [" + std::string (unit.symbol) + "]  " + s.socket->port->about;
    }
    else if (const auto* node = shown->nodeAt (at))
    {
        over = node->id;
        text = node->face->type == nullptr ? node->type : std::string (node->face->type->info.name) + ": " + std::string (node->face->type->info.summary);
    }
    else if (const auto* wire = shown->wireAt (at, wire_reach / window.zoom))
    {
        over = wire->id;
        text = wire->text;
    }
    hint (text);
    if (over == highlights.hovered) return;
    highlights.hovered = over;
    repaint();
}

void Canvas::mouseExit (const juce::MouseEvent&)
{
    highlights.hovered = 0;
    hint ({});
    repaint();
}

void Canvas::mouseDoubleClick (const juce::MouseEvent& e)
{
    const auto at = window.toCanvas (e.position);
    if (const auto* node = shown->nodeAt (at))
        enter (*node);
    else
        wantNode (at);
}

void Canvas::mouseWheelMove (const juce::MouseEvent& e, const juce::MouseWheelDetails& wheel)
{
    if (wheel.isSmooth && ! e.mods.isCommandDown())
        window.origin += juce::Point<float> (wheel.deltaX, wheel.deltaY) * 256.0f;
    else
        window.zoomAt (e.position, std::exp2 (wheel.deltaY));
    repaint();
}

void Canvas::mouseMagnify (const juce::MouseEvent& e, float factor)
{
    window.zoomAt (e.position, factor);
    repaint();
}

bool Canvas::keyPressed (const juce::KeyPress& key)
{
    const auto is = [&] (const char* description)
    { return key == juce::KeyPress::createFromDescription (description); };
    if (is ("delete") || is ("backspace"))
        removeSelection();
    else if (is ("ctrl + d"))
        duplicateSelection();
    else if (is ("ctrl + c"))
        copySelection();
    else if (is ("ctrl + x"))
    {
        copySelection();
        removeSelection();
    }
    else if (is ("ctrl + v"))
        pasteText();
    else if (is ("ctrl + z"))
        document.undo();
    else if (is ("ctrl + y") || is ("ctrl + shift + z"))
        document.redo();
    else if (is ("ctrl + a"))
    {
        Selection all;
        for (const auto& n : shown->nodes())
            all.insert (n.id);
        select (std::move (all));
    }
    else if (is ("f"))
        frameSelection();
    else if (is ("b"))
        document.perform (toggleBypass (document.graph(), patch(), highlights.selected));
    else if (is ("g"))
    {
        if (auto command = group (document.graph(), patch(), highlights.selected)) document.perform (std::move (*command));
    }
    else if (is ("tab") || is ("spacebar"))
        wantNode (window.toCanvas (getLocalBounds().contains (getMouseXYRelative()) ? getMouseXYRelative().toFloat() : getLocalBounds().getCentre().toFloat()));
    else
        return false;
    return true;
}

}   // namespace tactus::host
