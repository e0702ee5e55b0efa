// SPDX-License-Identifier: MIT
#pragma once

#include "quantity.hpp"
#include "result.hpp"

#include <string>
#include <string_view>

namespace tactus
{

/// A number with its dimension, in SI.
struct Measure
{
    double value = 0.0;
    Dimension dimension;
    bool angular = false;   ///< contains radians or degrees, which have no dimension: "6 rad/s" is not 6 Hz
};

/// Reads "0.4 mm", "1200 1/m", "2 N/mm", "60 mN", "1e-4 m/N", "5 %", "30 deg", "0.5" (a bare number has no dimension).
/// Grammar: a number, then factors joined by *, a space or /. Each factor is a unit with an optional SI prefix and an optional
/// integer power ("J/m2", "m^2", "s-1"). Factors are read from left to right; a slash divides by the one factor after it.
/// Units: m g s N J W Pa Hz rad, with the prefixes p n u (or µ) m c d k M G; deg and %, without prefixes. A prefix only shifts
/// the decimal point, so "0.4 mm" is the same double as 0.0004. There is no "min" and no "dB": decibels are bare numbers.
/// An error (unit/syntax) has neither a location nor a remedy.
Result<Measure> parseMeasure (std::string_view text);

/// The usual way to write a dimension in SI: "N/m", "m/s", or "kg*m2/s3" if the unit does not have its own symbol. parseMeasure can
/// read it.
std::string symbolOf (Dimension);

}   // namespace tactus
