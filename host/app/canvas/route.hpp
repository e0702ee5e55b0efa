// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// The places by which a wire goes, so that it does not run behind nodes: none where the direct way is free. A wire that
/// goes back, to the left, goes around below its ends. `obstacles` are the boxes of all other nodes, `start` and `end` those
/// at its ends.
std::vector<juce::Point<float>> routeAround (juce::Point<float> from, juce::Point<float> to, juce::Rectangle<float> start, juce::Rectangle<float> end, const std::vector<juce::Rectangle<float>>& obstacles);

/// A smooth line from left to right through all of these.
juce::Path curveThrough (juce::Point<float> from, const std::vector<juce::Point<float>>& by, juce::Point<float> to);

}   // namespace tactus::host
