// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Ways of putting boxes in line.
enum class Alignment
{
    left,
    right,
    top,
    bottom,
    columns,   ///< one under another, with the same gaps
    rows       ///< one beside another, with the same gaps
};

/// The boxes in line, in the order they came. Their size stays; what reaches furthest to that side stays where it is.
std::vector<juce::Rectangle<float>> aligned (std::vector<juce::Rectangle<float>>, Alignment);

}   // namespace tactus::host
