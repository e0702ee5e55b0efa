// SPDX-License-Identifier: GPL-3.0-or-later
// The parts of the canvas that are painted again after an edit, and the view after undo and redo.
#include "canvas.hpp"
#include "paint/paint_nodes.hpp"
#include "paint/squares.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>

namespace tactus::host
{

namespace
{
bool hasSameTexts (const Socket& x, const Socket& y) { return x.value == y.value && x.driver == y.driver && x.depth == y.depth && x.label == y.label; }

bool isSame (const SceneNode& a, const SceneNode& b)
{
    return a.name == b.name && a.type == b.type && a.at == b.at && a.bypass == b.bypass && std::ranges::equal (a.box.sockets, b.box.sockets, hasSameTexts);
}

/// Large graphs have thousands of nodes, and Scene::find() looks at one after another.
template <typename Item>
std::unordered_map<graph::Id, const Item*> byId (std::span<const Item> items)
{
    std::unordered_map<graph::Id, const Item*> all;
    for (const auto& i : items)
        all.emplace (i.id, &i);
    return all;
}

/// Collects what is in one scene and is missing or different in another one.
void collectChanges (const Scene& scene, const Scene& other, std::vector<juce::Rectangle<float>>& changed)
{
    const auto nodes = byId<SceneNode> (other.nodes());
    for (const auto& n : scene.nodes())
        if (const auto same = nodes.find (n.id); same == nodes.end() || ! isSame (n, *same->second)) changed.push_back (n.bounds());
    const auto wires = byId<SceneWire> (other.wires());
    for (const auto& w : scene.wires())
    {
        const auto same = wires.find (w.id);
        if (same == wires.end() || same->second->text != w.text || same->second->enabled != w.enabled)
            changed.push_back (juce::Rectangle<float> (w.from, w.to).withSizeKeepingCentre (1.0f, 1.0f));
    }
    for (std::size_t i = 0; i < scene.notes().size(); ++i)
    {
        const auto& note = scene.notes()[i];
        const bool has = i < other.notes().size();
        if (! has || other.notes()[i].area != note.area || other.notes()[i].text != note.text) changed.push_back (note.area);
    }
}

bool looksSame (const SceneNode& a, const SceneNode& b)
{
    const auto sameSocket = [&] (const Socket& x, const Socket& y) {
        return x.at == y.at && hasSameTexts (x, y) && x.port->role == y.port->role && x.port->isChoice() == y.port->isChoice()
               && a.quantityOf (*x.port) == b.quantityOf (*y.port);
    };
    return a.name == b.name && a.type == b.type && a.at == b.at && a.bypass == b.bypass && a.curve == b.curve && a.face->kind == b.face->kind
           && a.box.width == b.box.width && a.box.height == b.box.height && std::ranges::equal (a.box.sockets, b.box.sockets, sameSocket);
}

bool looksSame (const SceneWire& a, const SceneWire& b)
{
    return a.from == b.from && a.to == b.to && a.waypoints == b.waypoints && a.has_bends == b.has_bends && a.quantity == b.quantity && a.width == b.width
           && a.delay == b.delay && a.add == b.add && a.enabled == b.enabled;
}

bool looksSame (const Note& a, const Note& b) { return a.area == b.area && a.text == b.text && a.colour == b.colour; }

bool looksSame (const Scene::ExposedPort& a, const Scene::ExposedPort& b)
{
    return a.at == b.at && a.role == b.role && a.name == b.name && a.quantity == b.quantity && a.label == b.label;
}

/// Returns whether any item is not, or looks different, among the others.
template <typename Item, typename Repaint>
bool repaintDifferent (const std::vector<Item>& items, const std::vector<Item>& others, const Repaint& repaintItem)
{
    const auto known = byId<Item> (others);
    bool differ = false;
    for (const auto& i : items)
        if (const auto other = known.find (i.id); other == known.end() || ! looksSame (i, *other->second))
        {
            repaintItem (i);
            differ = true;
        }
    return differ;
}
}   // namespace

void Canvas::repaintEdit (const Scene& before)
{
    const auto same = [] (const auto& a, const auto& b) { return looksSame (a, b); };
    if (shown->nodes().empty() || before.nodes().empty() || ! std::ranges::equal (shown->notes(), before.notes(), same)
        || ! std::ranges::equal (shown->exposed(), before.exposed(), same))
        return repaint();
    bool are_moved = false;
    Squares along_wires (getWidth(), getHeight());
    const float around = 2.0f + 16.0f * window.zoom;   // what is painted on a wire
    const auto repaintWhatIsNew = [&] (const Scene& scene, const Scene& other) {
        are_moved |= repaintDifferent (scene.nodes(), other.nodes(), [this] (const SceneNode& n) { repaintAround (boundsOf (n, window.zoom)); });
        repaintDifferent (scene.wires(), other.wires(), [&] (const SceneWire& w) { along_wires.markAlong ({ w.path(), window.transform() }, around); });
    };
    repaintWhatIsNew (*shown, before);
    repaintWhatIsNew (before, *shown);
    for (const auto& area : along_wires.marked())
        repaint (area);
    for (const auto* scene : { &before, shown.get() })
        if (are_moved) repaint (Minimap (*scene, window, getLocalBounds()).bounds().getSmallestIntegerContainer());
}

/// If an edit moved the view and the user has not moved it since, undoing the edit moves it back. Otherwise, the view stays where something that has
/// changed is in view, and else goes to what has changed.
void Canvas::followStep (const Scene& before)
{
    if (const auto reached = views.step (viewState()))
    {
        window = reached->window;
        framed = reached->framed;
        framed_around = reached->framed_around;
        return repaint();
    }
    std::vector<juce::Rectangle<float>> changed;
    collectChanges (*shown, before, changed);
    collectChanges (before, *shown, changed);
    const auto canvas = getLocalBounds().toFloat();
    const auto isSeen = [&] (const juce::Rectangle<float>& r) { return canvas.contains (window.toPixels (r.getCentre())); };
    if (changed.empty() || canvas.isEmpty() || std::ranges::any_of (changed, isSeen)) return;
    window.centreOn (changed.front().getCentre(), canvas);
    repaint();
}

/// If the step that was undone or redone last has changed other patches than the one that is shown, goes to one of them, and selects what has changed.
void Canvas::revealStep()
{
    const auto to = document.history().position();
    const auto changed = partsOf (document.history(), to < *document.steppedFrom() ? to : to - 1);
    if (changed.empty() || changed.contains (patch())) return;
    const auto isName = [&] (const StepParts& p) {   // of a node that was entered, old and new: the breadcrumbs show it
        const auto isIn = [&] (const auto& entry) { return p.nodes.contains (entry.first); };
        return p.nodes.size() == 2 && std::ranges::any_of (breadcrumbs(), isIn);
    };
    if (changed.size() == 1 && isName (changed.begin()->second)) return;
    for (const auto& [name, parts] : changed)
    {
        show (name, 0);
        if (patch() != name) continue;   // no way leads there
        Selection all;
        for (const auto& n : shown->nodes())
            if (parts.nodes.contains (n.name)) all.insert (n.id);
        for (const auto& w : shown->wires())
            if (parts.wires.contains (w.id)) all.insert (w.id);
        if (all.empty()) return;
        show (name, *all.begin());
        return select (std::move (all));
    }
}

}   // namespace tactus::host
