// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_pictures.hpp"
#include "paint_nodes.hpp"

#include <cmath>

namespace tactus::host
{

void NodePictures::paint (juce::Graphics& g, const Scene& scene, const View& view, const Look& look, const Highlights& highlights, std::uint64_t version)
{
    auto& context = g.getInternalContext();
    const float scale = context.getPhysicalPixelScaleFactor();
    const bool fits_pixels = scale == std::round (scale) && scale >= 1.0f && ! context.isVectorDevice();
    const auto& live = highlights.live;
    Ground now { view, scale, &look.theme(), version, highlights.selected, highlights.hovered, {} };
    now.live.states = live.states;   // all but what wires carry
    now.live.costs = live.costs;
    now.live.driven = live.driven;
    now.live.problems = live.problems;
    now.live.limits = live.limits;
    if (! fits_pixels || highlights.fits || now != ground)
    {
        ground = std::move (now);
        pictures.clear();
        const juce::Graphics::ScopedSaveState state (g);
        g.addTransform (view.transform());
        return paintNodes (g, scene, view, look, highlights);
    }
    for (const auto& n : scene.nodes())
    {
        const auto area = boundsOf (n, view.zoom).transformedBy (view.transform()).getSmallestIntegerContainer();
        if (! g.clipRegionIntersects (area)) continue;
        if (highlights.selected.contains (n.id))   // it may move with the pointer
        {
            const juce::Graphics::ScopedSaveState state (g);
            g.addTransform (view.transform());
            paintNode (g, n, view, look, highlights);
            continue;
        }
        auto& picture = pictures[n.id];
        if (! picture.image.isValid() || picture.at != n.at)
        {
            const int pixels = juce::roundToInt (scale);
            picture = { n.at, juce::Image (juce::Image::ARGB, area.getWidth() * pixels, area.getHeight() * pixels, true, juce::SoftwareImageType()) };
            juce::Graphics into (picture.image);
            into.addTransform (view.transform().translated (-area.getPosition().toFloat()).scaled (scale));
            paintNode (into, n, view, look, highlights);
        }
        g.setOpacity (1.0f);
        g.drawImageTransformed (picture.image, juce::AffineTransform::scale (1.0f / scale).translated (area.getPosition().toFloat()));
    }
}

}   // namespace tactus::host
