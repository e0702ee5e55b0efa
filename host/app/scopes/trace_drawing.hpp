// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "look_at.hpp"
#include "scope_plot.hpp"

namespace tactus::host
{

/// A trace over time. Where many ticks share a column of pixels, it spans from the lowest to the highest of them.
void drawTrace (juce::Graphics&, const Lane&, const TraceColumns&, double tick_of_zero, double rate_hz, juce::Colour);

/// The area between two curves that share their columns; what has a gap in either is left out.
void drawBetween (juce::Graphics&, const Lane&, const std::vector<juce::Point<double>>& low, const std::vector<juce::Point<double>>& high, juce::Colour);

}   // namespace tactus::host
