// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "scope_plot.hpp"
#include "trace_window.hpp"

namespace tactus::host
{

/// Draws a trace over time. Where many ticks share a column of pixels, the line spans from the lowest to the highest of them.
void drawTrace (juce::Graphics&, const Lane&, const TraceColumns&, double tick_of_zero, double rate_hz, juce::Colour);

using Points = std::vector<juce::Point<double>>;

/// Fills the area between two curves with the same columns, except where either has a gap.
void drawBetween (juce::Graphics&, const Lane&, const Points& low, const Points& high, juce::Colour);

}   // namespace tactus::host
