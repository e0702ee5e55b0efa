// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Places for boxes that wires join, so that most wires run from left to right: columns by the longest way from where
/// nothing comes in, and within a column near to what they are joined with, with room left for long wires to pass
/// (after Sugiyama, Tagawa and Toda 1981). A wire that closes a loop counts for nothing. No place is before (0, 0).
std::vector<juce::Point<float>> arrange (const std::vector<juce::Point<float>>& sizes, const std::vector<std::pair<int, int>>& wires);

}   // namespace tactus::host
