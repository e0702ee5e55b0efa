// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "theme.hpp"

#include <cstddef>

namespace tactus::host
{

/// The shade of a component of a vector whose colour is `hue`: x, y and z by number.
inline juce::Colour componentColour (const Theme& theme, juce::Colour hue, std::size_t component)
{
    if (component == 1) return hue.interpolatedWith (theme.text, 0.5f);
    if (component == 2) return hue.interpolatedWith (theme.canvas, 0.42f);
    return hue;
}

}   // namespace tactus::host
