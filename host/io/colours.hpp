// SPDX-License-Identifier: GPL-3.0-or-later
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

/// The colour of a quantity, the same on ports, wires, traces and in print (Okabe and Ito's palette, which colour-blind
/// eyes tell apart). Grey for what has none of its own.
Colour colourFor (std::string_view quantity) noexcept;

/// The colour of the n-th of several traces of one quantity: its own first (blue, where it has none), then the others
/// of the palette, round and round.
Colour colourFor (std::string_view quantity, std::size_t nth) noexcept;

/// The colour, darkened if it is too faint on white paper; of the palette, the yellow is.
Colour onPaper (Colour colour) noexcept;

}   // namespace tactus::host
