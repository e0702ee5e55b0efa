// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/text/quantity.hpp>

#include <juce_graphics/juce_graphics.h>

#include <array>

namespace tactus::host
{

/// The colours of the window by role. The dark and light themes have the same roles.
struct Theme
{
    juce::Colour canvas, dots;            ///< canvas: its background; dots: its grid
    juce::Colour panel, raised;           ///< panel: panels and node bodies; raised: fields and buttons on them
    juce::Colour hairline, text, dim;     ///< dim: labels, units, secondary text
    juce::Colour accent, warning, stop;   ///< accent: selected or live; warning: out of the usual range; stop: faults and the stop button
    std::array<juce::Colour, 3> axes;     ///< x, y and z: hues that colour-blind people can tell apart
    bool is_dark = true;

    /// The colour of a quantity for ports, wires and traces.
    juce::Colour of (Quantity) const;

    static const Theme& dark();
    static const Theme& light();
};

}   // namespace tactus::host
