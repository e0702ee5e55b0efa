// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint_scene.hpp"

#include <host/app/look/glyph.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr float corner = 5.0f, socket_radius = 4.0f;
constexpr float too_small_to_read = 0.35f;   // zoom

class NodePainter
{
public:
    NodePainter (juce::Graphics& graphics, const Look& l, const Highlights& h, float z) : g (graphics), look (l), theme (l.theme()), highlights (h), words (z > too_small_to_read) {}

    void operator() (const SceneNode& node) const
    {
        const auto bounds = node.bounds();
        const bool selected = highlights.selected.contains (node.id);
        g.setColour (juce::Colours::black.withAlpha (theme.is_dark ? 0.35f : 0.10f));
        g.fillRoundedRectangle (bounds.translated (0.0f, 2.0f).expanded (1.0f), corner);
        g.setColour (theme.raised);
        g.fillRoundedRectangle (bounds, corner);
        header (node);
        g.setColour (selected ? theme.accent : highlights.hovered == node.id ? theme.dim
                                                                             : theme.hairline);
        g.drawRoundedRectangle (bounds.reduced (0.5f), corner, selected ? 2.0f : 1.0f);
        for (const auto& s : node.box.sockets)
            socket (node, s);
        if (node.face->kind == Face::Kind::placeholder) frame (bounds, theme.warning);
    }

private:
    void header (const SceneNode& node) const
    {
        if (! words) return;
        const auto area = node.bounds().withHeight (Box::header_height);
        const auto family = node.face->kind == Face::Kind::subgraph ? std::string ("graph") : node.type.substr (0, node.type.find ('.'));
        const float alpha = node.bypass ? 0.4f : 1.0f;
        g.setColour (theme.dim.withMultipliedAlpha (alpha));
        g.strokePath (glyphOf (family), juce::PathStrokeType (1.3f, juce::PathStrokeType::curved, juce::PathStrokeType::rounded),
                      juce::AffineTransform::translation (area.getX() + Box::padding, area.getCentreY() - 7.0f));
        g.setColour (theme.text.withMultipliedAlpha (alpha));
        g.setFont (look.font (Box::title_size, true));
        g.drawText (node.name, area.withTrimmedLeft (Box::padding + 22.0f), juce::Justification::centredLeft, false);
        if (node.bypass) g.drawLine ({ area.getBottomLeft().translated (Box::padding, -14.0f), area.getBottomRight().translated (-Box::padding, -14.0f) }, 1.0f);
        g.setColour (theme.hairline);
        g.drawHorizontalLine (juce::roundToInt (area.getBottom()) - 1, area.getX() + 1.0f, area.getRight() - 1.0f);
    }

    void socket (const SceneNode& node, const Socket& s) const
    {
        const bool fits = ! highlights.fits || highlights.fits (node, *s.port);
        const float alpha = fits ? (node.bypass ? 0.5f : 1.0f) : 0.2f;
        const auto place = node.placeOf (s);
        const auto row = s.row.translated (node.at.x, node.at.y).withX (node.at.x).withWidth (node.box.width).reduced (Box::padding, 0.0f);
        if (! s.port->isChoice())
        {
            const auto colour = theme.of (node.quantityOf (*s.port)).withMultipliedAlpha (alpha);
            const float r = s.port->role == Role::param ? socket_radius - 1.0f : socket_radius;
            g.setColour (theme.raised);
            g.fillEllipse (juce::Rectangle<float> (2 * r + 3, 2 * r + 3).withCentre (place));
            g.setColour (colour);
            if (s.port->role == Role::param)
                g.drawEllipse (juce::Rectangle<float> (2 * r, 2 * r).withCentre (place), 1.5f);
            else
                g.fillEllipse (juce::Rectangle<float> (2 * r, 2 * r).withCentre (place));
            if (highlights.fits && fits) g.drawEllipse (juce::Rectangle<float> (2 * r + 6, 2 * r + 6).withCentre (place), 1.5f);
        }
        if (! words) return;
        g.setFont (look.font (Box::label_size));
        g.setColour ((s.port->role == Role::param ? theme.dim : theme.text).withMultipliedAlpha (alpha));
        g.drawText (s.port->id, row, s.port->role == Role::output ? juce::Justification::centredRight : juce::Justification::centredLeft, false);
        g.setColour (theme.text.withMultipliedAlpha (alpha));
        if (s.port->role == Role::param) g.drawText (s.value, row, juce::Justification::centredRight, false);
    }

    void frame (juce::Rectangle<float> bounds, juce::Colour colour) const
    {
        juce::Path outline, dashed;
        outline.addRoundedRectangle (bounds.expanded (3.0f), corner + 2.0f);
        const float dashes[] { 5.0f, 4.0f };
        juce::PathStrokeType (1.5f).createDashedStroke (dashed, outline, dashes, 2);
        g.setColour (colour);
        g.fillPath (dashed);
    }

    juce::Graphics& g;
    const Look& look;
    const Theme& theme;
    const Highlights& highlights;
    bool words;
};

void paintDelay (juce::Graphics& g, const SceneWire& w, const Look& look)
{
    const auto path = w.path();
    const auto middle = path.getPointAlongPath (path.getLength() / 2);
    const auto text = juce::String (w.delay);
    const auto font = look.font (11.0f, true);
    const auto box = juce::Rectangle<float> (std::max (18.0f, font.getStringWidthFloat (text) + 8.0f), 16.0f).withCentre (middle);
    g.setColour (look.theme().canvas);
    g.fillRoundedRectangle (box, 3.0f);
    g.setColour (look.theme().of (w.quantity));
    g.drawRoundedRectangle (box, 3.0f, 1.2f);
    g.setFont (font);
    g.setColour (look.theme().text);
    g.drawText (text, box, juce::Justification::centred, false);
}
}   // namespace

void paintGrid (juce::Graphics& g, const View& view, juce::Rectangle<int> area, const Theme& theme)
{
    g.fillAll (theme.canvas);
    float step = 3 * Box::grid * view.zoom;
    while (step < 14.0f)
        step *= 2.0f;
    g.setColour (theme.dots);
    const auto first = [step] (float origin, int begin)
    { return static_cast<float> (begin) + std::fmod (std::fmod (origin - static_cast<float> (begin), step) + step, step); };
    for (float y = first (view.origin.y, area.getY()); y < static_cast<float> (area.getBottom()); y += step)
        for (float x = first (view.origin.x, area.getX()); x < static_cast<float> (area.getRight()); x += step)
            g.fillRect (x, y, 1.5f, 1.5f);
}

void paintWire (juce::Graphics& g, const SceneWire& w, const Theme& theme, bool selected, bool hovered)
{
    const auto path = w.path();
    const float thickness = w.width == 3 ? 3.0f : 1.5f;
    if (selected || hovered)
    {
        g.setColour (theme.accent.withAlpha (selected ? 0.6f : 0.3f));
        g.strokePath (path, juce::PathStrokeType (thickness + 4.0f));
    }
    g.setColour (theme.of (w.quantity).withMultipliedAlpha (w.enabled ? 1.0f : 0.35f));
    if (w.enabled && ! w.add)
    {
        g.strokePath (path, juce::PathStrokeType (thickness));
        return;
    }
    juce::Path dashed;
    const float dashes[] { w.add ? 8.0f : 3.0f, 4.0f };
    juce::PathStrokeType (thickness).createDashedStroke (dashed, path, dashes, 2);
    g.fillPath (dashed);
}

void paintScene (juce::Graphics& g, const Scene& scene, const View& view, const Look& look, const Highlights& highlights)
{
    const juce::Graphics::ScopedSaveState state (g);
    const auto clip = g.getClipBounds().toFloat();
    const juce::Rectangle<float> seen { view.toCanvas (clip.getTopLeft()), view.toCanvas (clip.getBottomRight()) };
    g.addTransform (view.transform());

    for (const auto& w : scene.wires())
    {
        if (! juce::Rectangle<float> (w.from, w.to).expanded (200.0f, 16.0f).intersects (seen)) continue;
        paintWire (g, w, look.theme(), highlights.selected.contains (w.id), highlights.hovered == w.id);
        if (w.delay > 0 && view.zoom > too_small_to_read) paintDelay (g, w, look);
    }
    const NodePainter paint { g, look, highlights, view.zoom };
    for (const auto& n : scene.nodes())
        if (n.bounds().expanded (8.0f).intersects (seen)) paint (n);
}

}   // namespace tactus::host
