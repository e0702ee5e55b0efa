// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "navigation/view.hpp"
#include "scene.hpp"

#include <host/app/look/theme.hpp>

namespace tactus::host
{

/// An overview in a corner of the canvas, if possible one without nodes, with the visible area marked. Shown while part of the scene is out of view.
class Minimap
{
public:
    Minimap (const Scene&, const View&, juce::Rectangle<int> window);

    bool isShown() const noexcept { return ! area.isEmpty(); }
    juce::Rectangle<float> bounds() const noexcept { return area; }   ///< in pixels

    /// The canvas position under a pixel of the map.
    juce::Point<float> toCanvas (juce::Point<float> pixel) const noexcept { return world.getPosition() + (pixel - inner.getPosition()) / scale; }

    void paint (juce::Graphics&, const Theme&) const;

private:
    juce::Rectangle<float> freeCorner (const View&, juce::Rectangle<float> inside, juce::Rectangle<float> size) const;
    juce::Rectangle<float> toMap (juce::Rectangle<float> r) const noexcept { return (r - world.getPosition()) * scale + inner.getPosition(); }

    const Scene& scene;
    juce::Rectangle<float> seen, world, area, inner;
    float scale = 1.0f;
};

}   // namespace tactus::host
