// SPDX-License-Identifier: GPL-3.0-or-later
// What the mouse and the keys do on the canvas, and the text editor over it.
#include "canvas.hpp"
#include "drags.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/model/param_now.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

std::unique_ptr<Drag> Canvas::dragFor (const juce::MouseEvent& e)
{
    if (e.mods.isMiddleButtonDown() || e.mods.isRightButtonDown()) return panBy (*this, e);
    const Minimap map { *shown, window, getLocalBounds() };
    if (with_map && map.isShown() && map.bounds().contains (e.position)) return panByMap (*this, e);
    const auto at = window.toCanvas (e.position);
    const auto grabBend = [&] (const Bend& bend) {
        selectBend (bend);
        return moveBend (*this, bend, false);
    };
    if (const auto bend = bendAt (at, true)) return grabBend (*bend);
    if (const auto over = shown->socketAt (at, socket_reach / window.zoom); over && ! over.socket->port->isChoice())
    {
        if (e.mods.isShiftDown() && over.socket->port->role != Role::output)
            if (auto replug = replugWire (*this, *over.node, *over.socket->port)) return replug;
        return drawWire (*this, { over.node->id, over.socket->port->role, over.socket->port->id });
    }

    const bool add = e.mods.isShiftDown() || e.mods.isCommandDown();
    const auto grab = [&] (graph::Id id) {
        auto chosen = highlights.selected;
        if (add)
        {
            if (! chosen.insert (id).second) chosen.erase (id);
        }
        else if (! chosen.contains (id))
            chosen = { id };
        if (chosen != highlights.selected) select (std::move (chosen));
    };
    if (const auto* node = shown->nodeAt (at))
    {
        if (const auto* socket = node->paramAt (at); socket != nullptr && ! e.mods.isCommandDown())
        {
            if (! highlights.selected.contains (node->id)) select ({ node->id });
            if (e.mods.isAltDown())
            {
                if (socket->driver.empty())
                    edits.setParam (*shown->find (node->id), *socket->port, std::nullopt);
                else
                    notice (drivenText (socket->driver));
                return nullptr;
            }
            if (auto dragged = dragParam (*this, *node, *socket)) return dragged;
        }
        grab (node->id);
        if (e.mods.isAltDown()) edits.duplicateSelection();
        return moveSelection (*this, e);
    }
    if (const auto bend = bendAt (at, false)) return grabBend (*bend);
    if (const auto* wire = shown->wireAt (at, wire_reach / window.zoom))
    {
        if (e.mods.isAltDown())
        {
            const auto bend = edits.addBend (wire->id, at);
            return bend ? moveBend (*this, *bend, true) : nullptr;
        }
        auto chosen = add ? highlights.selected : Selection {};
        chosen.insert (wire->id);
        select (std::move (chosen));
        return nullptr;
    }
    if (const auto note = shown->noteAt (at))
    {
        grab (noteId (*note));
        return shown->isCorner (*note, at) ? resizeNote (*this, e, *note) : moveSelection (*this, e);
    }
    return lasso (*this, e);
}

void Canvas::mouseDown (const juce::MouseEvent& e)
{
    text_editor.close (true);
    takeFocus (*this);
    point ({});
    drag_begins_at = document.history().position();
    drag = dragFor (e);
}

bool Canvas::cancelDrag()
{
    if (! drag) return false;
    drag.reset();
    hint ({});
    while (document.history().position() > drag_begins_at)   // a copy that is dragged makes two steps
        document.undo();
    repaint();
    return true;
}

void Canvas::mouseDrag (const juce::MouseEvent& e)
{
    if (drag) drag->move (e);
}

void Canvas::mouseUp (const juce::MouseEvent& e)
{
    if (const auto ended = std::exchange (drag, nullptr)) ended->end (e);
    if (const auto during = shown; ! during->isRouted())
    {
        rebuild();
        repaintEdit (*during);
    }
    const bool is_click = ! e.source.hasMovedSignificantlySincePressed() && document.history().position() == drag_begins_at;
    if (is_click && e.mods.isLeftButtonDown() && ! e.mods.isAnyModifierKeyDown() && highlights.selected.size() > 1)
    {
        // A drag moves the whole selection, but a click selects one of its nodes or notes.
        const auto at = window.toCanvas (e.position);
        const auto* node = shown->nodeAt (at);
        const auto note = node == nullptr ? shown->noteAt (at) : std::nullopt;
        graph::Id id = note ? noteId (*note) : 0;
        if (node != nullptr) id = node->id;
        if (highlights.selected.contains (id)) select ({ id });
    }
    if (e.mods.isRightButtonDown() && ! e.source.hasMovedSignificantlySincePressed())   // however long it was held
    {
        const auto at = window.toCanvas (e.position);
        const auto* node = shown->nodeAt (at);
        const auto* wire = shown->wireAt (at, wire_reach / window.zoom);
        graph::Id id = wire != nullptr ? wire->id : 0;
        if (node != nullptr) id = node->id;
        if (id != 0 && ! highlights.selected.contains (id)) select ({ id });
        showMenu (at, juce::PopupMenu::Options().withMousePosition());
    }
    repaint();
}

void Canvas::showMenuOfSelection()
{
    auto at = getLocalBounds().getCentre().toFloat();
    if (const auto nodes = edits.selectedNodes(); ! nodes.empty()) at = window.toPixels (nodes[0]->bounds().getTopLeft());
    at = getLocalBounds().toFloat().getConstrainedPoint (at);
    const auto place = localAreaToGlobal (juce::Rectangle<int> (at.roundToInt(), at.roundToInt()).expanded (1));
    showMenu (window.toCanvas (at), juce::PopupMenu::Options().withTargetScreenArea (place));
}

/// On a param: its menu, with the commands of the canvas in a submenu.
void Canvas::showMenu (juce::Point<float> at, const juce::PopupMenu::Options& place)
{
    juce::PopupMenu menu, of_param;
    const auto* node = shown->nodeAt (at);
    const auto over = shown->socketAt (at, socket_reach / window.zoom);
    const auto* param = node == nullptr ? nullptr : node->paramAt (at);
    if (over && over.socket->port->role == Role::param)
    {
        node = over.node;
        param = over.socket;
    }
    if (param != nullptr && onParamMenu) onParamMenu (of_param, node->name, param->port->id);
    for (const auto& c : canvasCommands())
    {
        if (! c.in_menu || ! c.can (*this)) continue;
        juce::PopupMenu::Item item (juce::translate (c.name));
        const auto keys = juce::StringArray::fromTokens (c.keys, "|", {});
        if (! keys.isEmpty()) item.shortcutKeyDescription = keyText (keys[0]);
        item.action = [safe = SafePointer (this), &c] {
            if (safe != nullptr && c.can (*safe)) c.run (*safe);
        };
        menu.addItem (std::move (item));
        if (c.ends_group) menu.addSeparator();
    }
    if (of_param.getNumItems() > 0)
    {
        of_param.addSeparator();
        of_param.addSubMenu (TRANS ("Node"), menu);
        menu = of_param;
    }
    menu.showMenuAsync (place.withParentComponent (this));
}

void Canvas::mouseDoubleClick (const juce::MouseEvent& e)
{
    const auto at = window.toCanvas (e.position);
    if (const auto bend = bendAt (at, true))
        edits.removeBend (*bend);
    else if (const auto* node = shown->nodeAt (at))
    {
        const auto* socket = node->paramAt (at);
        socket == nullptr ? enter (*node) : edits.editParam (*node, *socket);
    }
    else if (const auto* wire = shown->wireAt (at, wire_reach / window.zoom))
        edits.requestNode ({ at, {}, wire->id });
    else if (const auto note = shown->noteAt (at))
        edits.editNote (*note);
    else
        edits.requestNode ({ at });
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
    if (text_editor.isOpen() && key.isKeyCode (juce::KeyPress::tabKey))
    {
        text_editor.tab (key.getModifiers().isShiftDown() ? -1 : 1);
        return true;
    }
    bool is_known = false;
    for (const auto& c : canvasCommands())
        for (const auto& keys : juce::StringArray::fromTokens (c.keys, "|", {}))
            if (key == juce::KeyPress::createFromDescription (keys))
            {
                is_known = true;
                if (! c.can (*this))
                {
                    if (*c.lacks != 0) notice (juce::translate (c.lacks));
                    continue;   // another command may have the same key
                }
                c.run (*this);
                return true;
            }
    return is_known;
}

void Canvas::openEditor (juce::Rectangle<float> area, const juce::String& text, TextOverlay::Kind kind, std::function<bool (const juce::String&)> done,
                         std::function<void (int)> next)
{
    const auto box = juce::Rectangle<float> (window.toPixels (area.getTopLeft()), window.toPixels (area.getBottomRight())).toNearestInt();
    text_editor.open (box, text, kind, std::move (done), std::move (next));
}

}   // namespace tactus::host
