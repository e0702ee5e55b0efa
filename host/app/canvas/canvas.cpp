// SPDX-License-Identifier: GPL-3.0-or-later
#include "canvas.hpp"
#include "commands.hpp"
#include "drags.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/look/key_text.hpp>
#include <host/app/model/patch.hpp>
#include <host/app/model/wire_rules.hpp>
#include <host/app/text/filled.hpp>
#include <tactus/graph/instances.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace tactus::host
{

namespace
{
bool leadsTo (const graph::Node& node, const std::string& subgraph) { return node.type == "graph:" + subgraph; }

/// The subgraph nodes on the path to a patch. Empty if the patch cannot be reached from the root.
std::optional<Canvas::Breadcrumbs> breadcrumbsTo (const graph::Graph& g, const std::string& patch)
{
    std::vector<Canvas::Breadcrumbs> open { {} };
    std::set<std::string> seen;
    for (std::size_t i = 0; i < open.size(); ++i)
    {
        const auto path = open[i];
        const auto here = path.empty() ? std::string() : path.back().second;
        if (here == patch) return path;
        const auto* in = findPatch (g, here);
        if (in == nullptr || ! seen.insert (here).second) continue;
        for (const auto& n : in->nodes)
            if (n.type.starts_with ("graph:"))
            {
                open.push_back (path);
                open.back().emplace_back (n.name, n.type.substr (6));
            }
    }
    return std::nullopt;
}

/// Follows renamed nodes and subgraphs after an edit, and cuts the path before the first node that no longer exists.
void updateBreadcrumbs (Canvas::Breadcrumbs& path, const graph::Graph& g)
{
    const auto* in = &g.root;
    for (std::size_t i = 0; i < path.size(); ++i)
    {
        auto& [name, subgraph] = path[i];
        const auto* node = in->find (name);
        if (node != nullptr && node->type.starts_with ("graph:") && g.find (subgraph) == nullptr) subgraph = node->type.substr (6);
        if (node == nullptr || ! leadsTo (*node, subgraph))
        {
            const auto other = std::ranges::find_if (in->nodes, [&to = subgraph] (const graph::Node& n) { return leadsTo (n, to); });
            if (other == in->nodes.end()) return path.resize (i);
            name = other->name;
        }
        in = g.find (subgraph);
        if (in == nullptr) return path.resize (i);
    }
}
}   // namespace

Canvas::Canvas (Document& d, const Catalogue& c) : document (d), catalogue (c), seen_position (d.history().position())
{
    setWantsKeyboardFocus (true);
    setTitle (TRANS ("Canvas"));
    document.add (*this);
    rebuild();
}

Canvas::~Canvas() { document.remove (*this); }

void Canvas::documentChanged()
{
    std::set<graph::Id> before;
    for (const auto& n : shown->nodes())
        before.insert (n.id);
    if (! document.isStepping()) beginEdit();
    const auto previous = std::move (shown);
    updateBreadcrumbs (entered, document.graph());
    rebuild();
    if (document.isStepping()) followStep (*previous);
    // A view that the user has not moved stays fitted when a node appears outside of it, such as by a click in another panel.
    const auto isOut = [&] (const SceneNode& n) {
        const auto b = n.bounds();
        return ! before.contains (n.id)
               && ! getLocalBounds().toFloat().contains (juce::Rectangle<float> (window.toPixels (b.getTopLeft()), window.toPixels (b.getBottomRight())));
    };
    if (framed && *framed == window && ! drag && ! document.isStepping())
    {
        juce::Rectangle<float> out;
        for (const auto& n : shown->nodes())
            if (isOut (n)) out = out.isEmpty() ? n.bounds() : out.getUnion (n.bounds());
        if (! out.isEmpty()) framed_around.isEmpty() ? frameAll() : frameAround (out);
    }
    endEdit();
    std::erase_if (highlights.selected, [this] (graph::Id id) {
        if (isNote (id)) return noteOf (id) >= shown->notes().size();
        return shown->find (id) == nullptr && shown->findWire (id) == nullptr;
    });
    if (onBreadcrumbs) onBreadcrumbs();
    if (onSelection) onSelection();
}

void Canvas::rebuild()
{
    const auto& look = lookOf (*this);
    shown = std::make_unique<Scene> (document.graph(), patch(), catalogue, curves,
                                     [&look] (const std::string& text, float size, bool bold) { return look.font (size, bold).getStringWidthFloat (text); });
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

void Canvas::selectAll()
{
    Selection all;
    for (const auto& n : shown->nodes())
        all.insert (n.id);
    for (std::size_t i = 0; i < shown->notes().size(); ++i)
        all.insert (noteId (i));
    select (std::move (all));
}

void Canvas::selectNext (juce::Point<float> direction)
{
    const SceneNode *from = nullptr, *next = nullptr;
    for (const auto& n : shown->nodes())
        if (highlights.selected.contains (n.id)) from = &n;
    float least = std::numeric_limits<float>::max();
    for (const auto& n : shown->nodes())
    {
        if (&n == from) continue;
        const auto d = n.bounds().getCentre() - (from == nullptr ? shown->bounds().getTopLeft() : from->bounds().getCentre());
        const float along = d.getDotProduct (direction), beside = std::abs (d.x * direction.y - d.y * direction.x);
        if (from != nullptr && along <= beside * 0.5f) continue;
        if (const float distance = along + 2.0f * beside; distance < least)
        {
            least = distance;
            next = &n;
        }
    }
    if (next != nullptr) select ({ next->id });
}

std::string Canvas::address (const std::string& port) const
{
    std::string path, names;
    const auto* in = &document.graph().root;
    for (const auto& [name, subgraph] : entered)
    {
        const auto* node = in == nullptr ? nullptr : in->find (name);
        path += name;
        names += name + '/';
        if (const auto chosen = node == nullptr ? std::nullopt : instanceOf (*node, names)) path += '[' + std::to_string (chosen->number) + ']';
        path += '/';
        in = document.graph().find (subgraph);
    }
    return path + port;
}

std::optional<Canvas::Instance> Canvas::instanceOf (const graph::Node& node, const std::string& names) const
{
    const auto count = graph::countOf (node);
    if (! count || *count < 1) return {};
    const auto chosen = chosen_instances.find (names);
    return Instance { chosen == chosen_instances.end() ? 0 : std::clamp (chosen->second, 0, *count - 1), *count };
}

std::optional<Canvas::Instance> Canvas::instance() const
{
    std::string names;
    const auto* in = &document.graph().root;
    const graph::Node* node = nullptr;
    for (const auto& [name, subgraph] : entered)
    {
        node = in == nullptr ? nullptr : in->find (name);
        names += name + '/';
        in = document.graph().find (subgraph);
    }
    return node == nullptr ? std::nullopt : instanceOf (*node, names);
}

void Canvas::chooseInstance (int number)
{
    std::string names;
    for (const auto& [name, subgraph] : entered)
        names += name + '/';
    chosen_instances[names] = number;
    point ({});
    if (onBreadcrumbs) onBreadcrumbs();
}

void Canvas::breadcrumbsChanged()
{
    highlights = {};
    point ({});
    closeEditor (false);
    rebuild();
    frameStart();
    if (onBreadcrumbs) onBreadcrumbs();
    if (onSelection) onSelection();
}

void Canvas::leaveTo (std::size_t depth)
{
    if (depth >= entered.size()) return;
    const auto left = entered[depth].first;
    entered.resize (depth);
    breadcrumbsChanged();
    for (const auto& n : shown->nodes())
        if (n.name == left) select ({ n.id });
}

void Canvas::enter (const SceneNode& node)
{
    if (! node.type.starts_with ("graph:") || document.graph().find (node.type.substr (6)) == nullptr) return;
    entered.emplace_back (node.name, node.type.substr (6));
    breadcrumbsChanged();
}

void Canvas::show (const std::string& patch_name, graph::Id id)
{
    if (patch() != patch_name)
    {
        const auto path = breadcrumbsTo (document.graph(), patch_name);
        if (! path) return;
        entered = *path;
        breadcrumbsChanged();
    }
    if (id == 0) return;
    select ({ id });
    auto at = window.toCanvas (getLocalBounds().getCentre().toFloat());
    if (const auto* node = shown->find (id)) at = node->bounds().getCentre();
    if (const auto* wire = shown->findWire (id)) at = (wire->from + wire->to) / 2.0f;
    if (! getLocalBounds().toFloat().contains (window.toPixels (at))) window.centreOn (at, getLocalBounds().toFloat());
    repaint();
}

void Canvas::frameAll()
{
    window.frame (shown->bounds(), getLocalBounds().toFloat());
    framed = window;
    framed_around = {};
    repaint();
}

void Canvas::frameStart()
{
    const auto isDevice = [] (const SceneNode& n) { return n.type.starts_with ("device."); };
    const auto first = std::ranges::min_element (shown->nodes(), {}, [&] (const SceneNode& n) { return std::pair (! isDevice (n), n.at.x); });
    frameAround (first == shown->nodes().end() ? shown->bounds() : first->bounds());
}

void Canvas::frameAround (juce::Rectangle<float> focus)
{
    window.frameReadably (shown->bounds(), focus, getLocalBounds().toFloat());
    framed = window;
    framed_around = focus;
    repaint();
}

void Canvas::frameSelection()
{
    juce::Rectangle<float> area;
    const auto include = [&] (juce::Rectangle<float> r) { area = area.isEmpty() ? r : area.getUnion (r); };
    for (const auto* n : selectedNodes())
        include (n->bounds());
    for (std::size_t i = 0; i < shown->notes().size(); ++i)
        if (highlights.selected.contains (noteId (i))) include (shown->notes()[i].area);
    window.frame (area.isEmpty() ? shown->bounds() : area, getLocalBounds().toFloat());
    repaint();
}

void Canvas::zoomBy (float factor)
{
    window.zoomAt (getLocalBounds().getCentre().toFloat(), factor);
    repaint();
}

void Canvas::toggleMap()
{
    with_map = ! with_map;
    repaint();
}

juce::Point<float> Canvas::pointerOrCentre() const
{
    const auto pointer = getMouseXYRelative();
    return window.toCanvas ((getLocalBounds().contains (pointer) ? pointer : getLocalBounds().getCentre()).toFloat());
}

juce::String Canvas::getTooltip() { return drag ? juce::String() : tooltipAt (getMouseXYRelative().toFloat()); }

juce::String Canvas::tooltipAt (juce::Point<float> pixel) const
{
    constexpr float reach = 4.0f;   // pixels
    const auto at = window.toCanvas (pixel);
    for (const auto& [id, limit] : highlights.live.limits)
        if (const auto* node = shown->find (id); node != nullptr && limitLightOf (*node, window.zoom).expanded (reach / window.zoom).contains (at))
            return fromUtf8 (limit.text);
    return {};
}

void Canvas::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    paintGrid (g, window, g.getClipBounds(), look.theme());
    if (shown->nodes().empty())
    {
        g.setColour (look.theme().dim);
        g.setFont (look.font (14.0f));
        g.drawText (TRANS ("Press Space or double-click to add a node."), getLocalBounds(), juce::Justification::centred, true);
    }
    paintScene (g, *shown, window, look, highlights);
    if (with_map) Minimap (*shown, window, getLocalBounds()).paint (g, look.theme());
    if (file_over) paintFileOver (g);
    if (drag) return drag->paint (g);
    if (const auto& card = highlights.live.card) paintCard (g, *card, boundsOf (*card, window.toPixels (card->where.at), getLocalBounds()), look);
}

void Canvas::resized()
{
    const auto now = getLocalBounds().toFloat();
    if (now.getWidth() < 50.0f || now.getHeight() < 50.0f) return;
    if (! framed)
        frameStart();
    else if (*framed == window)
        framed_around.isEmpty() ? frameAll() : frameAround (framed_around);
    else
        window.origin += now.getCentre() - laid_out.getCentre();
    laid_out = now;
}

std::unique_ptr<Drag> Canvas::dragFor (const juce::MouseEvent& e)
{
    if (e.mods.isMiddleButtonDown() || e.mods.isRightButtonDown()) return panBy (*this, e);
    const Minimap map { *shown, window, getLocalBounds() };
    if (with_map && map.isShown() && map.bounds().contains (e.position)) return panByMap (*this, e);
    const auto at = window.toCanvas (e.position);
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
                setParam (*shown->find (node->id), *socket->port, std::nullopt);
                return nullptr;
            }
            if (auto dragged = dragParam (*this, *node, *socket)) return dragged;
        }
        grab (node->id);
        if (e.mods.isAltDown()) duplicateSelection();
        return moveSelection (*this, e);
    }
    if (const auto* wire = shown->wireAt (at, wire_reach / window.zoom))
    {
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
    closeEditor (true);
    takeFocus (*this);
    point ({});
    drag = dragFor (e);
}

void Canvas::mouseDrag (const juce::MouseEvent& e)
{
    if (drag) drag->move (e);
}

void Canvas::mouseUp (const juce::MouseEvent& e)
{
    if (const auto ended = std::exchange (drag, nullptr)) ended->end (e);
    if (e.mods.isRightButtonDown() && ! e.mouseWasDraggedSinceMouseDown())
    {
        const auto at = window.toCanvas (e.position);
        const auto* node = shown->nodeAt (at);
        const auto* wire = shown->wireAt (at, wire_reach / window.zoom);
        graph::Id id = wire != nullptr ? wire->id : 0;
        if (node != nullptr) id = node->id;
        if (id != 0 && ! highlights.selected.contains (id)) select ({ id });
        showMenu();
    }
    repaint();
}

void Canvas::showMenu()
{
    juce::PopupMenu menu;
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
    menu.showMenuAsync (juce::PopupMenu::Options().withMousePosition().withParentComponent (getTopLevelComponent()));
}

void Canvas::mouseDoubleClick (const juce::MouseEvent& e)
{
    const auto at = window.toCanvas (e.position);
    if (const auto* node = shown->nodeAt (at))
    {
        const auto* socket = node->paramAt (at);
        socket == nullptr ? enter (*node) : editParam (*node, *socket);
    }
    else if (const auto* wire = shown->wireAt (at, wire_reach / window.zoom))
        requestNode ({ at, {}, wire->id });
    else if (const auto note = shown->noteAt (at))
        editNote (*note);
    else
        requestNode ({ at });
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
    bool is_known = false;
    for (const auto& c : canvasCommands())
        for (const auto& keys : juce::StringArray::fromTokens (c.keys, "|", {}))
            if (key == juce::KeyPress::createFromDescription (keys))
            {
                is_known = true;
                if (! c.can (*this)) continue;   // another command may have the same key
                c.run (*this);
                return true;
            }
    return is_known;
}

}   // namespace tactus::host
