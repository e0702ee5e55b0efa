// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// The size of what a viewport shows: as large as the part of the viewport that the scroll bars leave free, but no smaller than a least size.
struct SizeInView
{
    int width = 0, height = 0;
    int seen_width = 0;   ///< how much of the width is seen at a time
};

inline SizeInView sizeInView (juce::Rectangle<int> viewport, juce::Point<int> least, int bar_thickness)
{
    const auto left = [bar_thickness] (int extent, bool has_bar) { return std::max (0, extent - (has_bar ? bar_thickness : 0)); };
    const bool too_high = least.y > left (viewport.getHeight(), least.x > viewport.getWidth());
    const int width = left (viewport.getWidth(), too_high), height = left (viewport.getHeight(), least.x > width);
    return { std::max (width, least.x), std::max (height, least.y), width };
}

}   // namespace tactus::host
