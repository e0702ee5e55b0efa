// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scene.hpp"
#include "view.hpp"

#include <host/app/look/theme.hpp>

namespace tactus::host
{

/// All of a scene in a corner of its canvas, and which part of it is seen. It is there while not all is.
class Minimap
{
public:
    Minimap (const Scene&, const View&, juce::Rectangle<int> window);

    bool isShown() const noexcept { return ! area.isEmpty(); }
    juce::Rectangle<float> bounds() const noexcept { return area; }   ///< pixels

    /// The place of the canvas that is shown there.
    juce::Point<float> toCanvas (juce::Point<float> pixel) const noexcept { return world.getPosition() + (pixel - inner.getPosition()) / scale; }

    void paint (juce::Graphics&, const Theme&) const;

private:
    juce::Rectangle<float> toMap (juce::Rectangle<float> r) const noexcept { return (r - world.getPosition()) * scale + inner.getPosition(); }

    const Scene& scene;
    juce::Rectangle<float> seen, world, area, inner;
    float scale = 1.0f;
};

}   // namespace tactus::host
