// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// The waypoints of a wire that keep it from running behind nodes; empty if the direct path is free. A wire that runs back to
/// the left goes below both ends, or, if one of them is in the way there, between them or above. `start` and `end` are the boxes at
/// its ends, `obstacles` the boxes of all other nodes.
std::vector<juce::Point<float>> routeAround (juce::Point<float> from, juce::Point<float> to, juce::Rectangle<float> start, juce::Rectangle<float> end,
                                             const std::vector<juce::Rectangle<float>>& obstacles);

/// Points every 8 units along a path, to find which of many boxes it leads through.
class PathPoints
{
public:
    explicit PathPoints (const juce::Path&);
    bool areIn (juce::Rectangle<float> box) const;   ///< true if one of them is

private:
    static constexpr std::size_t in_group = 16;
    std::vector<juce::Point<float>> points;
    std::vector<juce::Rectangle<float>> groups;   // the bounds of each 16 points
};

/// A smooth curve through all of these points, which is level at each of them.
juce::Path curveThrough (juce::Point<float> from, const std::vector<juce::Point<float>>& by, juce::Point<float> to);

/// A smooth curve through points that may lie anywhere. It leaves its start to the right and comes to its end from the left.
juce::Path curveThroughBends (juce::Point<float> from, const std::vector<juce::Point<float>>& by, juce::Point<float> to);

}   // namespace tactus::host
