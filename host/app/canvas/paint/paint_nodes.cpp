// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint_nodes.hpp"

#include <host/app/limits/limit_light.hpp>
#include <host/app/look/family.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/glyph.hpp>

#include <algorithm>
#include <array>

namespace tactus::host
{

namespace
{
constexpr float corner = 5.0f, socket_radius = 4.0f;
constexpr float labels_too_small = 0.44f;   // zoom below which the labels of ports are too small: less than 5.3 pixels
constexpr float least_title = 10.0f;        // pixels
constexpr float widest_name = 1.6f;         // of a node that is too small to read, as a multiple of its width

class NodePainter
{
public:
    NodePainter (juce::Graphics& graphics, const Look& l, const Highlights& h, float z)
        : g (graphics), look (l), theme (l.theme()), highlights (h), zoom (z), is_readable (z > View::too_small_to_read), has_labels (z > labels_too_small)
    {
    }

    void operator() (const SceneNode& node) const
    {
        const auto bounds = node.bounds();
        const bool selected = highlights.selected.contains (node.id);
        if (zoom < View::too_small_for_names) return boxAlone (node, selected);
        g.setColour (juce::Colours::black.withAlpha (theme.is_dark ? 0.35f : 0.10f));
        g.fillRoundedRectangle (bounds.translated (0.0f, 2.0f).expanded (1.0f), corner);
        g.setColour (is_readable ? theme.raised : headerColour (theme, familyOf (node)).withMultipliedAlpha (node.bypass ? 0.4f : 1.0f));
        g.fillRoundedRectangle (bounds, corner);
        is_readable ? header (node) : nameAlone (node);
        const auto outline = highlights.hovered == node.id ? theme.dim : theme.hairline;
        g.setColour (selected ? theme.accent : outline);
        g.drawRoundedRectangle (bounds.reduced (0.5f), corner, selected ? 2.0f : 1.0f);
        for (const auto& s : node.box.sockets)
            if (is_readable || highlights.fits) socket (node, s);
        if (node.curve != nullptr && is_readable)
            paintSmallCurve (g, node.box.plot + node.at, *node.curve, theme, node.bypass ? 0.4f : 1.0f);
        if (node.face->kind == Face::Kind::placeholder) frame (bounds, theme.warning);
        if (highlights.live.problems.contains (node.id)) frame (bounds, theme.stop);
        cost (node);
        limitLight (node);
    }

private:
    static std::string familyOf (const SceneNode& node)
    {
        return node.face->kind == Face::Kind::subgraph ? std::string ("graph") : node.type.substr (0, node.type.find ('.'));
    }

    /// Paints a node that has few pixels. One still sees whether it is selected, has a problem or breaks a limit.
    void boxAlone (const SceneNode& node, bool selected) const
    {
        const float pixel = 1.0f / zoom;
        g.setColour (headerColour (theme, familyOf (node)).withMultipliedAlpha (node.bypass ? 0.4f : 1.0f));
        g.fillRect (node.bounds());
        const bool has_problem = highlights.live.problems.contains (node.id), is_unknown = node.face->kind == Face::Kind::placeholder;
        if (has_problem || is_unknown)
        {
            g.setColour (has_problem ? theme.stop : theme.warning);
            g.drawRect (node.bounds(), 2.0f * pixel);
        }
        if (selected || highlights.hovered == node.id)
        {
            g.setColour (selected ? theme.accent : theme.dim);
            g.drawRect (node.bounds().expanded (pixel), 2.0f * pixel);
        }
        limitLight (node);
    }

    void limitLight (const SceneNode& node) const
    {
        if (const auto limit = highlights.live.limits.find (node.id); limit != highlights.live.limits.end())
            drawLimitLight (g, limitLightOf (node, zoom), limit->second.is_broken, theme);
    }

    /// The name at a readable size on screen. It may extend over the edges of a small node.
    void nameAlone (const SceneNode& node) const
    {
        constexpr float size = 10.0f, least_width = 20.0f;   // pixels
        if (node.box.width * zoom < least_width) return;
        const auto font = look.font (size / zoom);
        const float width = std::clamp (font.getStringWidthFloat (node.name) + 2.0f / zoom, node.box.width, widest_name * node.box.width);
        g.setColour (theme.text.withMultipliedAlpha (node.bypass ? 0.4f : 1.0f));
        g.setFont (font);
        g.drawText (node.name, node.bounds().withSizeKeepingCentre (width, node.box.height), juce::Justification::centred, true);
    }

    void header (const SceneNode& node) const
    {
        const auto area = node.bounds().withHeight (Box::header_height);
        const auto family = familyOf (node);
        const float alpha = node.bypass ? 0.4f : 1.0f;
        juce::Path top;
        top.addRoundedRectangle (area.getX(), area.getY(), area.getWidth(), area.getHeight(), corner, corner, true, true, false, false);
        g.setColour (headerColour (theme, family).withMultipliedAlpha (alpha));
        g.fillPath (top);
        const auto font = look.font (std::max (Box::title_size, least_title / zoom), true);
        const auto beside_glyph = area.withTrimmedLeft (Box::padding + 22.0f).withTrimmedRight (4.0f);
        const bool has_glyph = zoom >= least_title / Box::title_size || font.getStringWidthFloat (node.name) <= beside_glyph.getWidth();
        g.setColour (glyphColour (theme, family).withMultipliedAlpha (alpha));
        if (has_glyph)   // an enlarged title may need its space
            g.strokePath (glyphOf (family), juce::PathStrokeType (1.3f, juce::PathStrokeType::curved, juce::PathStrokeType::rounded),
                          juce::AffineTransform::translation (area.getX() + Box::padding, area.getCentreY() - 7.0f));
        g.setColour (theme.text.withMultipliedAlpha (alpha));
        g.setFont (font);
        g.drawText (node.name, has_glyph ? beside_glyph : area.reduced (4.0f, 0.0f), juce::Justification::centredLeft, true);
        if (const auto state = highlights.live.states.find (node.id); state != highlights.live.states.end()) light (area, state->second);
        const float middle = area.getBottom() - 14.0f;
        if (node.bypass) g.drawLine (area.getX() + Box::padding, middle, area.getRight() - Box::padding, middle, 1.0f);
        g.setColour (theme.hairline);
        g.drawHorizontalLine (juce::roundToInt (area.getBottom()) - 1, area.getX() + 1.0f, area.getRight() - 1.0f);
    }

    /// A lamp for the node's state; grey for state 0.
    void light (juce::Rectangle<float> header_area, int state) const
    {
        constexpr std::array lit { Quantity::energy, Quantity::hit, Quantity::force };
        const auto at = juce::Rectangle<float> (8.0f, 8.0f).withCentre ({ header_area.getRight() - Box::padding, header_area.getCentreY() });
        g.setColour (state <= 0 ? theme.hairline : theme.of (lit[static_cast<std::size_t> (state - 1) % lit.size()]));
        g.fillEllipse (at);
    }

    void cost (const SceneNode& node) const
    {
        const auto found = highlights.live.costs.find (node.id);
        if (found == highlights.live.costs.end()) return;
        constexpr double much = 0.5;
        const auto bar = node.bounds().withTop (node.bounds().getBottom() + 3.0f).withHeight (4.0f);
        g.setColour (theme.hairline);
        g.fillRoundedRectangle (bar, 2.0f);
        g.setColour (found->second > much ? theme.warning : theme.accent);
        g.fillRoundedRectangle (bar.withWidth (std::max (2.0f, bar.getWidth() * static_cast<float> (std::min (found->second, 1.0)))), 2.0f);
    }

    void socket (const SceneNode& node, const Socket& s) const
    {
        const bool fits = ! highlights.fits || highlights.fits (node, *s.port);
        const float bright = node.bypass ? 0.5f : 1.0f, alpha = fits ? bright : 0.2f;
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
        if (! has_labels) return;
        g.setFont (look.font (Box::label_size));
        g.setColour ((s.port->role == Role::param ? theme.dim : theme.text).withMultipliedAlpha (alpha));
        g.drawText (fromUtf8 (s.label), row, s.port->role == Role::output ? juce::Justification::centredRight : juce::Justification::centredLeft, false);
        if (s.port->role == Role::param) value (node, s, row, alpha);
    }

    /// Paints the value of a param. A value that a wire sets is dimmed, because the user cannot set it. It shows the value while the graph runs, else
    /// where it comes from. What modulates the value follows it.
    void value (const SceneNode& node, const Socket& s, juce::Rectangle<float> row, float alpha) const
    {
        if (! s.depth.empty())
        {
            const auto depth = fromUtf8 (s.depth);
            g.setColour (theme.axes[1].withMultipliedAlpha (alpha));
            g.drawText (depth, row, juce::Justification::centredRight, false);
            row.removeFromRight (look.font (Box::label_size).getStringWidthFloat (depth) + Box::before_depth);
        }
        g.setColour ((s.driver.empty() ? theme.text : theme.dim).withMultipliedAlpha (alpha));
        const auto now = s.driver.empty() ? highlights.live.driven.end() : highlights.live.driven.find ({ node.id, s.port->id });
        const auto& text = now == highlights.live.driven.end() ? (s.driver.empty() ? s.value : s.driver) : now->second;
        g.drawText (fromUtf8 (text), row, juce::Justification::centredRight, false);
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
    float zoom;
    bool is_readable, has_labels;   // large enough for the title, and for the labels
};
}   // namespace

juce::Rectangle<float> limitLightOf (const SceneNode& node, float zoom)
{
    constexpr float size = 10.0f, least_pixels = 6.0f, inset = 3.0f;
    const float side = std::max (size, least_pixels / zoom);
    return juce::Rectangle<float> (side, side).withCentre (node.bounds().getTopRight().translated (-inset, inset));
}

juce::Rectangle<float> boundsOf (const SceneNode& n, float zoom)
{
    const float beside = std::max (8.0f, 0.5f * (widest_name - 1.0f) * n.box.width);   // shadow, frame, or name
    return n.bounds().expanded (beside, 8.0f).getUnion (limitLightOf (n, zoom).expanded (1.0f));
}

void paintNode (juce::Graphics& g, const SceneNode& n, const View& view, const Look& look, const Highlights& highlights)
{
    NodePainter { g, look, highlights, view.zoom }(n);
}

void paintNodes (juce::Graphics& g, const Scene& scene, const View& view, const Look& look, const Highlights& highlights)
{
    for (const auto& n : scene.nodes())
        if (g.clipRegionIntersects (boundsOf (n, view.zoom).getSmallestIntegerContainer())) paintNode (g, n, view, look, highlights);
}

}   // namespace tactus::host
