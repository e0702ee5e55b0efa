// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Alignment and distribution commands.
enum class Alignment
{
    left,
    right,
    top,
    bottom,
    columns,   ///< distribute vertically, with equal gaps
    rows       ///< distribute horizontally, with equal gaps
};

/// Aligns or distributes boxes, without changing their order or sizes. Aligning leaves the outermost box on that side in place.
std::vector<juce::Rectangle<float>> aligned (std::vector<juce::Rectangle<float>>, Alignment);

}   // namespace tactus::host
