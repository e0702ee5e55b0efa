// SPDX-License-Identifier: GPL-3.0-or-later
#include "backdrop.hpp"
#include "paint_wires.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

bool Backdrop::Drawn::looksAs (const SceneWire& w, int level_now) const
{
    return from == w.from && to == w.to && waypoints == w.waypoints && has_bends == w.has_bends && quantity == w.quantity && width == w.width
           && level == level_now;
}

std::optional<Backdrop::Ground> Backdrop::groundOf (const juce::Graphics& g, juce::Rectangle<int> area, const Scene& scene, const View& view, const Look& look,
                                                    const Highlights& highlights)
{
    auto& context = g.getInternalContext();
    const float scale = context.getPhysicalPixelScaleFactor();
    const bool fits_pixels = scale == std::round (scale) && scale >= 1.0f && ! context.isVectorDevice();
    if (! fits_pixels || area.isEmpty() || Bundling (scene, highlights).isEmpty()) return std::nullopt;
    Ground now { .view = view, .scale = scale, .theme = &look.theme() };
    now.width = area.getWidth() * static_cast<int> (scale);
    now.height = area.getHeight() * static_cast<int> (scale);
    for (std::size_t i = 0; i < scene.notes().size(); ++i)
    {
        const auto& note = scene.notes()[i];
        now.notes.emplace_back (note.area, note.text, note.colour, highlights.selected.contains (noteId (i)));
    }
    return now;
}

bool Backdrop::paint (juce::Graphics& g, juce::Rectangle<int> area, const Scene& scene, const View& view, const Look& look, const Highlights& highlights)
{
    auto now = groundOf (g, area, scene, view, look, highlights);
    if (! now)
    {
        *this = {};   // it may be large
        return false;
    }
    if (*now != ground)
    {
        ground = std::move (*now);
        drawn.clear();
        if (picture.getWidth() != ground.width || picture.getHeight() != ground.height)
            picture = juce::Image (juce::Image::RGB, ground.width, ground.height, false, juce::SoftwareImageType());
        old = Squares (ground.width, ground.height);
        old.markAll (true);
    }
    noteWires (scene, highlights);
    paintOld (scene, look, highlights);
    g.setOpacity (1.0f);
    g.drawImageTransformed (picture, juce::AffineTransform::scale (1.0f / ground.scale));
    return true;
}

/// Compares the wires with those in the picture.
void Backdrop::noteWires (const Scene& scene, const Highlights& highlights)
{
    const Bundling bundled (scene, highlights);
    std::vector<juce::Path> changed;
    ++pass;
    for (const auto& w : scene.wires())
    {
        if (! bundled.contains (w)) continue;
        const int level = levelOf (w, highlights.live);
        auto [at, is_new] = drawn.try_emplace (w.id);
        auto& its = at->second;
        its.pass = pass;
        if (! is_new && its.looksAs (w, level)) continue;
        if (! is_new) changed.push_back (its.path());
        its = { w.from, w.to, w.waypoints, w.has_bends, w.quantity, w.width, level, pass };
        changed.push_back (its.path());
    }
    std::erase_if (drawn, [&] (const auto& wire) {
        if (wire.second.pass == pass) return false;
        changed.push_back (wire.second.path());
        return true;
    });
    constexpr std::size_t most = 200;   // more of them meet nearly all squares, such as when a run begins
    if (changed.size() > most) return old.markAll (true);
    const float around = (2.0f + 16.0f * ground.view.zoom) * ground.scale;   // the glow of a wire, and more
    for (const auto& path : changed)
        old.markAlong ({ path, ground.view.transform().scaled (ground.scale) }, around);
}

void Backdrop::paintOld (const Scene& scene, const Look& look, const Highlights& highlights)
{
    const auto count = old.count();
    if (count == 0) return;
    if (2 * count > old.size()) old.markAll (true);
    painted += old.count();
    const auto area = old.marked();
    old.markAll (false);

    juce::Graphics g (picture);
    g.reduceClipRegion (area);
    g.addTransform (juce::AffineTransform::scale (ground.scale));
    paintGrid (g, ground.view, g.getClipBounds(), look.theme());
    paintBelow (g, scene, ground.view, look, highlights);
}

}   // namespace tactus::host
