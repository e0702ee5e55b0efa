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

/// A wire between two boxes: where it leaves the first and enters the second, relative to their upper left corners.
struct Lead
{
    int from = 0, to = 0;
    juce::Point<float> out, in;
};

/// Moves the boxes that are not placed yet to free places among the others, which stay where they are: between the boxes that feed them and those
/// that they feed, where their wires are short and meet neither boxes nor other wires. A box without wires to the others gets below them.
void placeAmong (std::vector<juce::Rectangle<float>>& boxes, std::vector<bool> placed, const std::vector<Lead>& leads);

/// The place nearest to that of a box, straight above or below it, where it is clear of the others.
juce::Point<float> clearPlace (juce::Rectangle<float> box, const std::vector<juce::Rectangle<float>>& others);

/// Boxes that have grown to the right or downwards push those away that they would cover, which keep their distance. Boxes that met before are left alone.
void pushApart (const std::vector<juce::Rectangle<float>>& before, std::vector<juce::Rectangle<float>>& boxes);

}   // namespace tactus::host
