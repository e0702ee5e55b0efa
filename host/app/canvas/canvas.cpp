// SPDX-License-Identifier: GPL-3.0-or-later
#include "canvas.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

Canvas::Canvas (Document& d, const Catalogue& c) : document (d), catalogue (c)
{
    setOpaque (true);
    setWantsKeyboardFocus (true);
    setTitle (TRANS ("Canvas"));
    text_editor.onEscape = [this] { notice ({}); };   // no longer why the text was refused
    document.add (*this);
    rebuild();
}

Canvas::~Canvas() { document.remove (*this); }

void Canvas::documentChanged()
{
    std::map<graph::Id, juce::Point<float>> before;
    for (const auto& n : shown->nodes())
        before[n.id] = n.at;
    if (! document.isStepping()) views.begin (viewState());
    const auto previous = shown;
    const auto patch_before = patch();
    const auto depth_before = breadcrumbs().size();
    trail.follow();
    rebuild();
    if (patch() == patch_before && ! drag && ! document.isStepping()) edits.makeRoom (*previous);
    patch() == patch_before ? repaintEdit (*previous) : repaint();
    if (breadcrumbs().size() != depth_before) frameStart();   // the patch that was shown is gone
    if (document.isStepping())
    {
        followStep (*previous);
        revealStep();
    }
    // A view that the user has not moved stays fitted when a node appears outside of it or is moved there, such as by a click in another panel.
    const auto isOut = [&] (const SceneNode& n) {
        const auto b = n.bounds();
        const auto was = before.find (n.id);
        return (was == before.end() || was->second != n.at)
               && ! getLocalBounds().toFloat().contains (juce::Rectangle<float> (window.toPixels (b.getTopLeft()), window.toPixels (b.getBottomRight())));
    };
    if (isFitted() && ! drag && ! document.isStepping())
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
    if (const auto& b = highlights.bend)
        if (const auto* wire = shown->findWire (b->wire); wire == nullptr || ! wire->has_bends || b->number >= wire->waypoints.size()) highlights.bend.reset();
    if (onSelection) onSelection();
}

TextWidth Canvas::textWidth() const
{
    return [&look = lookOf (*this)] (const std::string& text, float size, bool bold) { return look.font (size, bold).getStringWidthFloat (text); };
}

void Canvas::rebuild()
{
    ++scenes_made;
    const bool is_only_moved = shown != nullptr && shown_of == std::pair (document.version(), seen());
    shown = is_only_moved ? std::make_shared<const Scene> (*shown, document.graph(), seen(), kept_places, textWidth(), drag != nullptr) : sceneOf (document.graph());
    shown_of = { document.version(), seen() };
}

std::shared_ptr<const Scene> Canvas::sceneOf (const graph::Graph& g)
{
    return std::make_shared<const Scene> (g, seen(), catalogue, curves, kept_places, textWidth());
}

void Canvas::hint (const juce::String& text)
{
    if (onHint) onHint (text);
}

void Canvas::select (Selection s)
{
    highlights.selected = std::move (s);
    highlights.bend.reset();
    repaint();
    if (onSelection) onSelection();
}

void Canvas::selectBend (const Bend& bend)
{
    select (Selection { bend.wire });
    highlights.bend = bend;
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
    if (shown->bounds().isEmpty()) window = {};   // an empty canvas is at 100 %, whatever was shown before
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

void Canvas::bringIntoView (juce::Rectangle<float> area)
{
    const auto canvas = getLocalBounds().toFloat();
    const juce::Rectangle<float> pixels (window.toPixels (area.getTopLeft()), window.toPixels (area.getBottomRight()));
    if (canvas.contains (pixels)) return;
    if (pixels.getWidth() < canvas.getWidth() && pixels.getHeight() < canvas.getHeight())
        window.centreOn (area.getCentre(), canvas);
    else
        window.frame (area, canvas);
    repaint();
    endEdit();
}

void Canvas::toggleMap()
{
    with_map = ! with_map;
    repaint();
}

juce::String Canvas::getTooltip() { return drag ? juce::String() : tooltipAt (getMouseXYRelative().toFloat()); }

void Canvas::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const bool has_backdrop = backdrop.paint (g, getLocalBounds(), *shown, window, look, highlights);
    if (! has_backdrop) paintGrid (g, window, g.getClipBounds(), look.theme());
    if (shown->nodes().empty())
    {
        g.setColour (look.theme().dim);
        g.setFont (look.font (14.0f));
        const auto above = getLocalBounds().reduced (8, 0).withHeight (hint_bottom.value_or (getHeight() / 2 + 10));
        g.drawFittedText (TRANS ("Press Space or double-click to add a node."), above, juce::Justification::centredBottom, 3, 1.0f);
    }
    if (! has_backdrop) paintBelow (g, *shown, window, look, highlights);
    if (! drag) node_pictures = {};   // they may be large
    const auto paintPictures = [&] { node_pictures.paint (g, *shown, window, look, highlights, document.version()); };
    paintAbove (g, *shown, window, look, highlights, drag ? std::function<void()> (paintPictures) : nullptr);
    if (with_map) Minimap (*shown, window, getLocalBounds()).paint (g, look.theme());
    if (file_over) paintFileOver (g);
    if (drag) return drag->paint (g);
    if (const auto& card = highlights.live.card) paintCard (g, *card, boundsOf (*card, window.toPixels (card->where.at), getLocalBounds()), look);
}

void Canvas::placeHint (int bottom)
{
    if (std::exchange (hint_bottom, bottom) != bottom && shown->nodes().empty()) repaint();
}

void Canvas::resized()
{
    const auto now = getLocalBounds().toFloat();
    if (now.getWidth() < 50.0f || now.getHeight() < 50.0f) return;
    if (! framed)
        frameStart();
    else if (isFitted())
        framed_around.isEmpty() ? frameAll() : frameAround (framed_around);
    else
        window.origin += now.getCentre() - laid_out.getCentre();
    laid_out = now;
}

}   // namespace tactus::host
