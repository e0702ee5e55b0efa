// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tactus::host
{

struct Colour
{
    std::uint8_t red = 0, green = 0, blue = 0;

    bool operator== (const Colour&) const = default;
};

/// The colour of a quantity, the same on ports, wires and traces and in print (Okabe and Ito's colour-blind-safe palette).
/// Grey for quantities without their own colour.
Colour colourFor (std::string_view quantity) noexcept;

/// The colour of the n-th of several traces of one quantity: first its own colour (blue if it has none), then the rest
/// of the palette, repeating.
Colour colourFor (std::string_view quantity, std::size_t nth) noexcept;

/// The colour at a level from 0 to 1 of a scale that runs from dark blue through green to bright yellow. The lightness increases evenly, so
/// the scale can also be read in greyscale and by colour-blind people (the points of matplotlib's viridis, by Smith and van der Walt).
Colour colourOfLevel (double part) noexcept;

/// The colour, darkened if it is too faint on white paper. In the palette, this applies only to yellow.
Colour onPaper (Colour colour) noexcept;

}   // namespace tactus::host
