// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint_scene.hpp"
#include "paint_nodes.hpp"
#include "paint_wires.hpp"

#include <host/app/look/fitted_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace tactus::host
{

namespace
{
juce::Colour colourOf (const Note& note, const Theme& theme)
{
    constexpr std::array quantities { Quantity::length, Quantity::force, Quantity::energy, Quantity::angle, Quantity::hit, Quantity::gain };
    const auto place = std::ranges::find (note_colours, note.colour);
    return place == std::end (note_colours) ? theme.dim : theme.of (quantities[static_cast<std::size_t> (place - std::begin (note_colours))]);
}

void paintNote (juce::Graphics& g, const Note& note, const Look& look, bool selected)
{
    const auto& theme = look.theme();
    const auto colour = colourOf (note, theme);
    const auto text = juce::String::fromUTF8 (note.text.c_str());
    if (note.isRegion())
    {
        g.setColour (colour.withAlpha (theme.is_dark ? 0.10f : 0.14f));
        g.fillRoundedRectangle (note.area, 8.0f);
        g.setColour (colour.withAlpha (0.55f));
        g.drawRoundedRectangle (note.area.reduced (0.5f), 8.0f, 1.0f);
        g.setFont (look.font (13.0f, true));
        g.setColour (theme.text);
        const auto title = note.area.withHeight (Box::header_height).reduced (12.0f, 0.0f);
        g.drawText (note.text.empty() ? TRANS ("Region") : text, title, juce::Justification::centredLeft, true);
    }
    else
    {
        g.setColour (theme.dim.withAlpha (0.6f));
        g.fillRect (note.area.withWidth (2.0f));
        g.setFont (look.font (13.0f));
        g.setColour (note.text.empty() ? theme.dim : theme.text);
        const auto area = note.area.reduced (10.0f, 4.0f).toNearestInt();
        g.drawFittedText (note.text.empty() ? TRANS ("Double-click to edit this note.") : text, area, juce::Justification::topLeft, 100, 1.0f);
    }
    g.setColour (colour.withAlpha (0.6f));
    for (const float d : { 5.0f, 9.0f })
        g.drawLine (note.area.getRight() - d, note.area.getBottom() - 2.0f, note.area.getRight() - 2.0f, note.area.getBottom() - d, 1.0f);
    if (! selected) return;
    g.setColour (theme.accent);
    g.drawRoundedRectangle (note.area.expanded (1.0f), 8.0f, 2.0f);
}

/// Paints an exposed port: its outer name, on the side where wires connect.
void paintExposed (juce::Graphics& g, const Scene::ExposedPort& e, const Look& look)
{
    const auto& box = e.label;
    const auto edge = e.at.withX (e.role == Role::output ? box.getX() : box.getRight());
    const auto colour = look.theme().of (e.quantity);
    g.setColour (colour);
    g.drawLine ({ e.at, edge }, 1.5f);
    g.setColour (look.theme().canvas);
    g.fillRoundedRectangle (box, box.getHeight() / 2);
    g.setColour (colour);
    g.drawRoundedRectangle (box.reduced (0.5f), box.getHeight() / 2, 1.2f);
    g.setFont (look.font (11.0f, true));
    g.setColour (look.theme().text);
    g.drawText (e.name, box, juce::Justification::centred, false);
}
}   // namespace

void paintGrid (juce::Graphics& g, const View& view, juce::Rectangle<int> area, const Theme& theme)
{
    g.fillAll (theme.canvas);
    float step = 3 * Box::grid * view.zoom;
    while (step < 14.0f)
        step *= 2.0f;
    g.setColour (theme.dots);
    const auto first = [step] (float origin, int begin) {
        const auto edge = static_cast<float> (begin);
        return edge + std::fmod (std::fmod (origin - edge, step) + step, step);
    };
    for (float y = first (view.origin.y, area.getY()); y < static_cast<float> (area.getBottom()); y += step)
        for (float x = first (view.origin.x, area.getX()); x < static_cast<float> (area.getRight()); x += step)
            g.fillRect (x, y, 1.5f, 1.5f);
}

void paintBelow (juce::Graphics& g, const Scene& scene, const View& view, const Look& look, const Highlights& highlights)
{
    const juce::Graphics::ScopedSaveState state (g);
    g.addTransform (view.transform());
    const auto seen = g.getClipBounds().toFloat();
    for (std::size_t i = 0; i < scene.notes().size(); ++i)
        if (scene.notes()[i].area.intersects (seen)) paintNote (g, scene.notes()[i], look, highlights.selected.contains (noteId (i)));
    paintBundles (g, scene, look.theme(), highlights);
}

void paintAbove (juce::Graphics& g, const Scene& scene, const View& view, const Look& look, const Highlights& highlights,
                 const std::function<void()>& paintsNodes)
{
    const auto onCanvas = [&] (const auto& paint) {
        const juce::Graphics::ScopedSaveState state (g);
        g.addTransform (view.transform());
        paint();
    };
    onCanvas ([&] {
        paintSingleWires (g, scene, view, look, highlights);
        if (view.zoom > View::too_small_to_read)
            for (const auto& e : scene.exposed())
                paintExposed (g, e, look);
        if (! paintsNodes) paintNodes (g, scene, view, look, highlights);
    });
    if (paintsNodes) paintsNodes();
    onCanvas ([&] { paintAboveNodes (g, scene, view, look.theme(), highlights); });
}

void paintScene (juce::Graphics& g, const Scene& scene, const View& view, const Look& look, const Highlights& highlights)
{
    paintBelow (g, scene, view, look, highlights);
    paintAbove (g, scene, view, look, highlights);
}

}   // namespace tactus::host
