// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_graphics/juce_graphics.h>

#include <algorithm>
#include <cmath>

namespace tactus::host::test
{

/// The contrast of two colours according to WCAG 2.1: 1 to 21.
inline double contrast (juce::Colour a, juce::Colour b)
{
    const auto light = [] (juce::Colour c) {
        const auto part = [] (float v) { return v <= 0.04045f ? v / 12.92 : std::pow ((static_cast<double> (v) + 0.055) / 1.055, 2.4); };
        return 0.2126 * part (c.getFloatRed()) + 0.7152 * part (c.getFloatGreen()) + 0.0722 * part (c.getFloatBlue());
    };
    return (std::max (light (a), light (b)) + 0.05) / (std::min (light (a), light (b)) + 0.05);
}

}   // namespace tactus::host::test
