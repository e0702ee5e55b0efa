// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "theme.hpp"

#include <cstddef>

namespace tactus::host
{

/// The colour of the n-th component of a port. A number has the colour of its quantity; x, y and z have a hue each.
inline juce::Colour componentColour (const Theme& theme, juce::Colour hue, std::size_t component, std::size_t components)
{
    return components == theme.axes.size() ? theme.axes[component] : hue;
}

}   // namespace tactus::host
