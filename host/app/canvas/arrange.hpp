// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Lays out boxes so that most wires run from left to right (after Sugiyama, Tagawa and Toda 1981). The column of a box is the
/// length of the longest path to it from a box without inputs. Within a column, a box is close to the boxes it is wired to, and
/// long wires have lanes. Wires that close a loop are ignored. No coordinate is negative.
std::vector<juce::Point<float>> arrange (const std::vector<juce::Point<float>>& sizes, const std::vector<std::pair<int, int>>& wires);

}   // namespace tactus::host
