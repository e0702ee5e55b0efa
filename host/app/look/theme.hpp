// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/quantity.hpp>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// The colours of the window by what they are for. Dark and light have the same roles.
struct Theme
{
    juce::Colour canvas, dots;            ///< behind the nodes, and its grid
    juce::Colour panel, raised;           ///< panels and bodies of nodes; fields and buttons on them
    juce::Colour hairline, text, dim;     ///< dim: labels, units, what matters less
    juce::Colour accent, warning, stop;   ///< what is selected or live; out of the usual; faults, and the stop itself
    bool is_dark = true;

    /// The colour of a quantity on the canvas: of ports, wires, traces.
    juce::Colour of (Quantity) const;

    static const Theme& dark();
    static const Theme& light();
};

}   // namespace tactus::host
