// SPDX-License-Identifier: MIT
#pragma once

#include "quantity.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace tactus
{

/// A number with its dimension, in SI.
struct Measure
{
    double value = 0.0;
    Dimension dimension;
};

/// Reads "0.4 mm", "1200 1/m", "2 N/mm", "60 mN", "1e-4 m/N", "5 %", "30 deg", "0.5" (a bare number has no dimension).
/// Grammar: a number, then factors joined by * or a space and /, each a unit with an optional SI prefix and an optional
/// integer power ("J/m2", "m^2", "s-1"). Returns the measure, or a sentence saying what is wrong with the text.
std::variant<Measure, std::string> parseMeasure (std::string_view text);

/// The usual way to write a dimension in SI: "N/m", "m/s", "kg*m2/s2" where it has no name.
std::string symbolOf (Dimension);

}   // namespace tactus
