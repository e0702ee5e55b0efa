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

/// Calls f with rectangles that contain what is painted on a path and up to `around` beside it, as far as it is in an area: much less than the
/// bounds of a wire, which most other wires of a large patch cross. In steps of a grid, because a region of many small rectangles takes long to
/// paint.
template <typename F>
void cellsAlong (juce::PathFlatteningIterator&& line, juce::Rectangle<float> area, float around, F&& f)
{
    constexpr int grid = 32;
    const auto snapped = [] (float x, bool up) { return grid * static_cast<int> (up ? std::ceil (x / grid) : std::floor (x / grid)); };
    cutLines (std::move (line), area.expanded (around), grid, [&] (const CutLine& cut) {
        for (int i = 0; i < cut.parts; ++i)
        {
            const auto piece = juce::Rectangle<float> (cut.at (i), cut.at (i + 1)).expanded (around);
            f (juce::Rectangle<int>::leftTopRightBottom (snapped (piece.getX(), false), snapped (piece.getY(), false), snapped (piece.getRight(), true),
                                                         snapped (piece.getBottom(), true)));
        }
    });
}

}   // namespace tactus::host
