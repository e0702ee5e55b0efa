// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/scene/scene.hpp>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// The surface of a graph under its tool, as a small picture for each theme.
struct MaterialPicture
{
    static constexpr int width = 256, height = 192;   ///< pixels

    juce::Image dark {}, light {};   ///< empty if the graph has nothing to see

    bool isEmpty() const noexcept { return dark.isNull(); }
    const juce::Image& of (const Theme& theme) const noexcept { return theme.is_dark ? dark : light; }
};

/// A mesh is shown as a whole, and a plane near the first tool. [any thread]
MaterialPicture materialOf (std::vector<scene::Body>, const scene::SceneState&);

}   // namespace tactus::host
