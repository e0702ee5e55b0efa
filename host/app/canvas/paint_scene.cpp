// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint_scene.hpp"

#include <host/app/limits/limit_light.hpp>
#include <host/app/look/family.hpp>
#include <host/app/look/fitted_text.hpp>
#include <host/app/look/glyph.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

namespace tactus::host
{

namespace
{
constexpr float corner = 5.0f, socket_radius = 4.0f;
constexpr float too_small_to_read = 0.35f;    // zoom below which text is too small to read: a node is a coloured box with its name
constexpr float too_small_for_names = 0.2f;   // zoom below which the names do not fit, either: a node is a coloured box
constexpr float labels_too_small = 0.44f;     // zoom below which the labels of ports are too small: less than 5.3 pixels
constexpr float least_title = 10.0f;          // pixels
constexpr float widest_name = 1.6f;           // of a node that is too small to read, as a multiple of its width

class NodePainter
{
public:
    NodePainter (juce::Graphics& graphics, const Look& l, const Highlights& h, float z)
        : g (graphics), look (l), theme (l.theme()), highlights (h), zoom (z), is_readable (z > too_small_to_read), has_labels (z > labels_too_small)
    {
    }

    void operator() (const SceneNode& node) const
    {
        const auto bounds = node.bounds();
        const bool selected = highlights.selected.contains (node.id);
        if (zoom < too_small_for_names) return boxAlone (node, selected);
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

    /// Whether the node is selected, has a problem or breaks a limit is seen even if it has few pixels.
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
    float zoom;
    bool is_readable, has_labels;   // large enough for the title, and for the labels
};

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

void paintProblem (juce::Graphics& g, const SceneWire& w, const Theme& theme)
{
    juce::Path dashed;
    const float dashes[] { 4.0f, 6.0f };
    juce::PathStrokeType (4.0f).createDashedStroke (dashed, w.path(), dashes, 2);
    g.setColour (theme.stop);
    g.fillPath (dashed);
}

void paintBends (juce::Graphics& g, const SceneWire& w, const Highlights& highlights, const Theme& theme)
{
    for (std::size_t i = 0; i < w.waypoints.size(); ++i)
    {
        const bool is_selected = highlights.bend == Bend { w.id, i };
        const float size = is_selected ? 10.0f : 7.0f;
        g.setColour (is_selected ? theme.accent : theme.of (w.quantity));
        g.fillEllipse (juce::Rectangle<float> (size, size).withCentre (w.waypoints[i]));
    }
}

void paintHit (juce::Graphics& g, const SceneWire& w, double along, const Theme& theme)
{
    const auto path = w.path();
    g.setColour (theme.of (Quantity::hit));
    const auto at = path.getPointAlongPath (path.getLength() * static_cast<float> (std::clamp (along, 0.0, 1.0)));
    g.fillEllipse (juce::Rectangle<float> (9.0f, 9.0f).withCentre (at));
}
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

namespace
{
/// What a stroke of a path shows in an area, as straight lines: the same ones as those into which JUCE divides the path before it strokes it.
juce::Path partIn (juce::Rectangle<float> area, const juce::Path& path, float scale)
{
    juce::Path part;
    juce::Point<float> end;
    for (juce::PathFlatteningIterator line (path, {}, juce::Path::defaultToleranceForMeasurement / scale); line.next();)
    {
        const juce::Point<float> a { line.x1, line.y1 }, b { line.x2, line.y2 };
        if (! area.intersects (juce::Rectangle<float> (a, b).expanded (1.0f))) continue;
        if (part.isEmpty() || a != end) part.startNewSubPath (a);
        part.lineTo (b);
        end = b;
    }
    return part;
}

bool isDashed (const SceneWire& w) { return w.add || ! w.enabled; }
float thicknessOf (const SceneWire& w) { return w.width == 3 ? 3.0f : 1.5f; }

juce::Path shownOf (const juce::Graphics& g, const SceneWire& w)
{
    constexpr float widest = 12.0f;   // of a stroke
    auto path = w.path();
    const auto seen = g.getClipBounds().toFloat().expanded (widest);
    if (isDashed (w) || seen.contains (path.getBounds())) return path;   // dashes are counted from the start of the wire
    return partIn (seen, path, g.getInternalContext().getPhysicalPixelScaleFactor());
}

struct Stroke
{
    juce::Colour colour;
    float thickness;
};

/// What a wire that carries something has below it, so that the wire itself keeps its contrast at rest.
Stroke glowOf (const SceneWire& w, const Theme& theme, int level)
{
    const float strength = static_cast<float> (level) / static_cast<float> (LiveState::most_level);
    return { theme.of (w.quantity).withAlpha (0.08f + 0.16f * strength), thicknessOf (w) + 3.0f + 2.0f * strength };
}

struct Pieces
{
    juce::Path path;
    juce::Point<float> end;
    int lines = 0;

    void add (juce::Point<float> from, juce::Point<float> to)
    {
        if (lines == 0 || from != end) path.startNewSubPath (from);
        path.lineTo (to);
        end = to;
        ++lines;
    }
};

/// What can be seen of a wire where something is painted again: an edit paints the wires that it changes, and so short pieces of many others.
Pieces piecesOf (const juce::Graphics& g, const SceneWire& w)
{
    constexpr float widest = 12.0f, longest_px = 64.0f;
    const float scale = g.getInternalContext().getPhysicalPixelScaleFactor(), longest = longest_px / scale;
    const auto seen = g.getClipBounds().toFloat().expanded (widest);
    const auto path = w.path();
    Pieces pieces;
    for (juce::PathFlatteningIterator line (path, {}, juce::Path::defaultToleranceForMeasurement / scale); line.next();)
    {
        const juce::Line<float> whole (line.x1, line.y1, line.x2, line.y2);
        if (! seen.intersects (juce::Rectangle<float> (whole.getStart(), whole.getEnd()).expanded (1.0f))) continue;
        const int parts = std::clamp (static_cast<int> (whole.getLength() / longest), 1, 1000);
        const auto pointAt = [&] (int i) {
            return i == parts ? whole.getEnd() : whole.getPointAlongLineProportionally (static_cast<float> (i) / static_cast<float> (parts));
        };
        const auto isSeen = [&] (int i) {
            return g.clipRegionIntersects (juce::Rectangle<float> (pointAt (i), pointAt (i + 1)).expanded (widest).getSmallestIntegerContainer());
        };
        for (int i = 0; i < parts; ++i)
        {
            const int first = i;
            while (i < parts && isSeen (i))
                ++i;
            if (i > first) pieces.add (pointAt (first), pointAt (i));
        }
    }
    return pieces;
}

/// Wires that look the same, a few together, because one at a time takes longer: for patches with so many wires that most lie on others.
class Bundles
{
public:
    void add (const juce::Graphics& g, const SceneWire& w, const Theme& theme, int level)
    {
        const auto pieces = piecesOf (g, w);
        if (pieces.lines == 0) return;
        if (level > 0) add (0, glowOf (w, theme, level), pieces);
        add (1, { theme.of (w.quantity), thicknessOf (w) }, pieces);
    }

    void paint (juce::Graphics& g) const
    {
        for (const auto& [look, bundles] : all)
            for (const auto& bundle : bundles)
            {
                g.setColour (juce::Colour (std::get<1> (look)));
                g.strokePath (bundle.path, juce::PathStrokeType (std::get<2> (look)));
            }
    }

private:
    static constexpr int most_lines = 256;   // those of 32 wires at most: JUCE copies the table of their edges each time that more meet in a row of pixels

    struct Bundle
    {
        juce::Path path;
        int lines = 0;
    };
    std::map<std::tuple<int, std::uint32_t, float>, std::vector<Bundle>> all;   // by layer, colour and thickness

    void add (int layer, const Stroke& stroke, const Pieces& pieces)
    {
        auto& bundles = all[{ layer, stroke.colour.getARGB(), stroke.thickness }];
        if (bundles.empty() || bundles.back().lines >= most_lines) bundles.emplace_back();
        bundles.back().path.addPath (pieces.path);
        bundles.back().lines += std::max (pieces.lines, most_lines / 32);
    }
};

void paintOnWire (juce::Graphics& g, const SceneWire& w, const View& view, const Look& look, const Highlights& highlights)
{
    if (highlights.live.problems.contains (w.id)) paintProblem (g, w, look.theme());
    if (const auto hit = highlights.live.hits.find (w.id); hit != highlights.live.hits.end()) paintHit (g, w, hit->second, look.theme());
    if (w.delay > 0 && view.zoom > too_small_to_read) paintDelay (g, w, look);
    if (w.has_bends && view.zoom > too_small_for_names) paintBends (g, w, highlights, look.theme());
}

void paintWires (juce::Graphics& g, const Scene& scene, juce::Rectangle<float> seen, const View& view, const Look& look, const Highlights& highlights)
{
    constexpr std::size_t many = 500;
    const auto levelOf = [&] (const SceneWire& w) {
        const auto found = highlights.live.levels.find (w.id);
        return found == highlights.live.levels.end() ? 0 : found->second;
    };
    const auto isBundled = [&] (const SceneWire& w) {
        return scene.wires().size() >= many && ! isDashed (w) && ! highlights.selected.contains (w.id) && highlights.hovered != w.id;
    };
    Bundles bundles;
    std::vector<const SceneWire*> shown;
    for (const auto& w : scene.wires())
        if (boundsOf (w).intersects (seen))
        {
            shown.push_back (&w);
            if (isBundled (w)) bundles.add (g, w, look.theme(), levelOf (w));
        }
    bundles.paint (g);
    for (const auto* w : shown)
    {
        if (! isBundled (*w)) paintWire (g, *w, look.theme(), highlights.selected.contains (w->id), highlights.hovered == w->id, levelOf (*w));
        paintOnWire (g, *w, view, look, highlights);
    }
}
}   // namespace

void paintWire (juce::Graphics& g, const SceneWire& w, const Theme& theme, bool selected, bool hovered, int level)
{
    const auto path = shownOf (g, w);
    if (path.isEmpty()) return;
    const float thickness = thicknessOf (w);
    if (level > 0)
    {
        const auto glow = glowOf (w, theme, level);
        g.setColour (glow.colour);
        g.strokePath (path, juce::PathStrokeType (glow.thickness));
    }
    if (selected || hovered)
    {
        g.setColour (theme.accent.withAlpha (selected ? 0.6f : 0.3f));
        g.strokePath (path, juce::PathStrokeType (thickness + 4.0f));
    }
    g.setColour (theme.of (w.quantity).withMultipliedAlpha (w.enabled ? 1.0f : 0.35f));
    if (! isDashed (w)) return g.strokePath (path, juce::PathStrokeType (thickness));
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

    for (std::size_t i = 0; i < scene.notes().size(); ++i)
        if (scene.notes()[i].area.intersects (seen)) paintNote (g, scene.notes()[i], look, highlights.selected.contains (noteId (i)));
    paintWires (g, scene, seen, view, look, highlights);
    if (view.zoom > too_small_to_read)
        for (const auto& e : scene.exposed())
            paintExposed (g, e, look);
    const NodePainter paint { g, look, highlights, view.zoom };
    for (const auto& n : scene.nodes())
        if (g.clipRegionIntersects (boundsOf (n, view.zoom).getSmallestIntegerContainer())) paint (n);
    for (const auto& w : scene.wires())   // above the nodes, where they can be grabbed
        if (w.has_bends && highlights.selected.contains (w.id) && view.zoom > too_small_for_names) paintBends (g, w, highlights, look.theme());
}

}   // namespace tactus::host
