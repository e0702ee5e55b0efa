// SPDX-License-Identifier: GPL-3.0-or-later
#include "minimap.hpp"

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr float map_width = 168.0f, map_height = 112.0f, margin = 12.0f, padding = 6.0f;
constexpr float widest = 0.25f, highest = 0.3f;   // parts of the canvas
constexpr float least_size = 0.5f;
}   // namespace

Minimap::Minimap (const Scene& s, const View& view, juce::Rectangle<int> window) : scene (s)
{
    const auto pixels = window.toFloat();
    seen = { view.toCanvas (pixels.getTopLeft()), view.toCanvas (pixels.getBottomRight()) };
    const float size = std::min ({ 1.0f, widest * pixels.getWidth() / map_width, highest * pixels.getHeight() / map_height });
    if (scene.nodes().empty() || seen.contains (scene.bounds()) || size < least_size) return;
    area = freeCorner (view, pixels.reduced (margin), { size * map_width, size * map_height });
    world = scene.bounds().getUnion (seen);
    const auto room = area.reduced (padding);
    scale = std::min (room.getWidth() / world.getWidth(), room.getHeight() / world.getHeight());
    inner = room.withSizeKeepingCentre (world.getWidth() * scale, world.getHeight() * scale);
}

/// The corner that no node is under, else the lower right one.
juce::Rectangle<float> Minimap::freeCorner (const View& view, juce::Rectangle<float> inside, juce::Rectangle<float> size) const
{
    const auto lower_right = size.withBottomY (inside.getBottom()).withRightX (inside.getRight());
    const auto isFree = [&] (juce::Rectangle<float> corner) {
        const juce::Rectangle<float> on_canvas (view.toCanvas (corner.getTopLeft()), view.toCanvas (corner.getBottomRight()));
        return std::ranges::none_of (scene.nodes(), [&] (const SceneNode& n) { return n.bounds().intersects (on_canvas); });
    };
    for (const auto& corner : { lower_right, lower_right.withX (inside.getX()), lower_right.withY (inside.getY()), size.withPosition (inside.getPosition()) })
        if (isFree (corner)) return corner;
    return lower_right;
}

void Minimap::paint (juce::Graphics& g, const Theme& theme) const
{
    if (! isShown()) return;
    g.setColour (theme.panel.withAlpha (0.92f));
    g.fillRoundedRectangle (area, 4.0f);
    g.setColour (theme.hairline);
    g.drawRoundedRectangle (area.reduced (0.5f), 4.0f, 1.0f);
    g.setColour (theme.dim.withAlpha (0.7f));
    for (const auto& n : scene.nodes())
    {
        const auto box = toMap (n.bounds());
        g.fillRect (box.withSize (std::max (box.getWidth(), 2.0f), std::max (box.getHeight(), 2.0f)));
    }
    g.setColour (theme.accent);
    g.drawRect (toMap (seen), 1.0f);
}

}   // namespace tactus::host
