// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_graphics/juce_graphics.h>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

/// A straight line, cut into parts of equal length.
struct CutLine
{
    juce::Line<float> whole;
    int parts = 1;

    /// The beginning of a part, or the end of the line.
    juce::Point<float> at (int part) const noexcept
    {
        return part == parts ? whole.getEnd() : whole.getPointAlongLineProportionally (static_cast<float> (part) / static_cast<float> (parts));
    }
};

/// Calls f with each straight line of a path that may reach an area, cut into parts that are little longer than `longest`.
template <typename F>
void cutLines (juce::PathFlatteningIterator&& line, juce::Rectangle<float> area, float longest, F&& f)
{
    constexpr int most_parts = 1000;
    while (line.next())
    {
        const juce::Line<float> whole (line.x1, line.y1, line.x2, line.y2);
        if (! area.intersects (juce::Rectangle<float> (whole.getStart(), whole.getEnd()).expanded (1.0f))) continue;
        f (CutLine { whole, std::clamp (static_cast<int> (whole.getLength() / longest), 1, most_parts) });
    }
}

}   // namespace tactus::host
