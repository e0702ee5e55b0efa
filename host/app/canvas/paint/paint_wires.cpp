// SPDX-License-Identifier: GPL-3.0-or-later
#include "paint_wires.hpp"
#include "cut_line.hpp"

#include <host/app/look/fitted_text.hpp>

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace tactus::host
{

namespace
{
constexpr float widest_stroke = 12.0f;   // of a stroke, in canvas units

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

bool isDashed (const SceneWire& w) { return w.add || ! w.enabled; }
float thicknessOf (const SceneWire& w) { return w.width == 3 ? 3.0f : 1.5f; }

struct Stroke
{
    juce::Colour colour;
    float thickness;
};

/// The glow below a wire that carries something. The wire itself keeps its contrast at rest.
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

/// What can be seen of a wire where something is painted again, as straight lines: the same ones as those into which JUCE divides a path before
/// it strokes it, and cut if they are longer than some pixels. An edit paints the wires that it changes, and so short pieces of many others.
Pieces piecesOf (const juce::Graphics& g, const juce::Path& path, float longest_px)
{
    const float scale = g.getInternalContext().getPhysicalPixelScaleFactor();
    const auto seen = g.getClipBounds().toFloat().expanded (widest_stroke);
    Pieces pieces;
    cutLines ({ path, {}, juce::Path::defaultToleranceForMeasurement / scale }, seen, longest_px / scale, [&] (const CutLine& cut) {
        const auto isSeen = [&] (int i) {
            return g.clipRegionIntersects (juce::Rectangle<float> (cut.at (i), cut.at (i + 1)).expanded (widest_stroke).getSmallestIntegerContainer());
        };
        for (int i = 0; i < cut.parts; ++i)
        {
            const int first = i;
            while (i < cut.parts && isSeen (i))
                ++i;
            if (i > first) pieces.add (cut.at (first), cut.at (i));
        }
    });
    return pieces;
}

juce::Path shownOf (const juce::Graphics& g, const SceneWire& w)
{
    auto path = w.path();
    const auto seen = g.getClipBounds().toFloat().expanded (widest_stroke);
    if (isDashed (w) || seen.contains (path.getBounds())) return path;   // dashes are counted from the start of the wire
    return piecesOf (g, path, std::numeric_limits<float>::infinity()).path;
}

void strokeWire (juce::Graphics& g, const SceneWire& w, const juce::Path& path, juce::Colour colour)
{
    g.setColour (colour);
    const juce::PathStrokeType stroke (thicknessOf (w));
    if (! isDashed (w)) return g.strokePath (path, stroke);
    juce::Path dashed;
    const float dashes[] { w.add ? 8.0f : 3.0f, 4.0f };
    stroke.createDashedStroke (dashed, path, dashes, 2);
    g.fillPath (dashed);
}

/// Wires that look the same, a few together, because one at a time takes longer: for patches with so many wires that most lie on others. A few,
/// because JUCE copies the table of their edges each time that many meet in a row of pixels. Which are together depends on their ids alone, so a
/// part of the picture that is painted again is as before.
class Bundles
{
public:
    void add (const juce::Graphics& g, const SceneWire& w, const Theme& theme, int level)
    {
        constexpr float longest_px = 64.0f;
        const auto pieces = piecesOf (g, w.path(), longest_px);
        if (pieces.lines == 0) return;
        if (level > 0) add (0, glowOf (w, theme, level), w, pieces);
        add (1, { theme.of (w.quantity), thicknessOf (w) }, w, pieces);
    }

    void paint (juce::Graphics& g) const
    {
        for (const auto& [key, path] : all)
        {
            g.setColour (juce::Colour (std::get<1> (key)));
            g.strokePath (path, juce::PathStrokeType (std::get<2> (key)));
        }
    }

private:
    std::map<std::tuple<int, std::uint32_t, float, graph::Id>, juce::Path> all;   // by layer, colour, thickness and ids

    void add (int layer, const Stroke& stroke, const SceneWire& w, const Pieces& pieces)
    {
        constexpr graph::Id together = 8;
        all[{ layer, stroke.colour.getARGB(), stroke.thickness, w.id / together }].addPath (pieces.path);
    }
};

void paintOnWire (juce::Graphics& g, const SceneWire& w, const View& view, const Look& look, const Highlights& highlights)
{
    if (highlights.live.problems.contains (w.id)) paintProblem (g, w, look.theme());
    if (const auto hit = highlights.live.hits.find (w.id); hit != highlights.live.hits.end()) paintHit (g, w, hit->second, look.theme());
    if (w.delay > 0 && view.zoom > View::too_small_to_read) paintDelay (g, w, look);
    if (w.has_bends && view.zoom > View::too_small_for_names) paintBends (g, w, highlights, look.theme());
}

}   // namespace

Bundling::Bundling (const Scene& s, const Highlights& h) : scene (s), highlights (h), has_very_many (s.wires().size() >= 500)
{
    constexpr std::ptrdiff_t most_lifted = 64;
    if (! has_very_many || h.selected.empty()) return;
    lifts = std::ranges::count_if (s.wires(), [this] (const SceneWire& w) { return isBesideSelected (w); }) <= most_lifted;
}

bool Bundling::isBesideSelected (const SceneWire& w) const
{
    const auto isSelected = [this] (int node) { return highlights.selected.contains (scene.nodes()[static_cast<std::size_t> (node)].id); };
    return isSelected (w.start) || isSelected (w.end);
}

bool Bundling::contains (const SceneWire& w) const
{
    return has_very_many && ! isDashed (w) && ! highlights.selected.contains (w.id) && highlights.hovered != w.id && ! (lifts && isBesideSelected (w));
}

int levelOf (const SceneWire& w, const LiveState& live)
{
    const auto found = live.levels.find (w.id);
    return found == live.levels.end() ? 0 : found->second;
}

void paintBundles (juce::Graphics& g, const Scene& scene, const Theme& theme, const Highlights& highlights)
{
    const Bundling bundled (scene, highlights);
    if (bundled.isEmpty()) return;
    const auto seen = g.getClipBounds().toFloat();
    Bundles bundles;
    for (const auto& w : scene.wires())
        if (boundsOf (w).intersects (seen) && bundled.contains (w)) bundles.add (g, w, theme, levelOf (w, highlights.live));
    bundles.paint (g);
}

void paintSingleWires (juce::Graphics& g, const Scene& scene, const View& view, const Look& look, const Highlights& highlights)
{
    const Bundling bundled (scene, highlights);
    const auto seen = g.getClipBounds().toFloat();
    for (const auto& w : scene.wires())
    {
        if (! boundsOf (w).intersects (seen)) continue;
        if (! bundled.contains (w))
            paintWire (g, w, look.theme(), highlights.selected.contains (w.id), highlights.hovered == w.id, levelOf (w, highlights.live));
        paintOnWire (g, w, view, look, highlights);
    }
}

void paintAboveNodes (juce::Graphics& g, const Scene& scene, const View& view, const Theme& theme, const Highlights& highlights)
{
    const auto seen = g.getClipBounds().toFloat();
    for (const auto& w : scene.wires())
    {
        const bool is_selected = highlights.selected.contains (w.id);
        if ((! is_selected && highlights.hovered != w.id) || ! boundsOf (w).intersects (seen)) continue;
        strokeWire (g, w, shownOf (g, w), theme.of (w.quantity).withMultipliedAlpha (w.enabled ? 0.4f : 0.2f));
        if (is_selected && w.has_bends && view.zoom > View::too_small_for_names) paintBends (g, w, highlights, theme);
    }
}

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
    strokeWire (g, w, path, theme.of (w.quantity).withMultipliedAlpha (w.enabled ? 1.0f : 0.35f));
}

}   // namespace tactus::host
