// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <utility>
#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Lays out boxes so that most wires run from left to right (after Sugiyama, Tagawa and Toda 1981). The column of a box is the
/// longest path from a box without inputs. Within a column, boxes are close to their neighbours, with lanes for long wires.
/// Wires that close a loop are ignored. All positions are at or beyond (0, 0).
std::vector<juce::Point<float>> arrange (const std::vector<juce::Point<float>>& sizes, const std::vector<std::pair<int, int>>& wires);

}   // namespace tactus::host
