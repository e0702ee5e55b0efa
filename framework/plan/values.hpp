// SPDX-License-Identifier: MIT
#pragma once

#include "flat.hpp"

#include <framework/units.hpp>

namespace tactus::plan
{

/// A number of a file: plain, or text with a unit. Without a unit it is in SI and fits any dimension.
struct Number
{
    double value = 0.0;
    std::optional<Dimension> dimension;
    bool angular = false;   ///< written in radians or degrees
};

/// True if the number counts radians where cycles are counted: "6 rad/s" given for 1 Hz.
bool miscounts (const Number&, const UnitRule&) noexcept;

/// What to say then.
std::string miscount (const Json&, const UnitRule&);

/// A value as it was written, cut where it grows long. Text from the command line may be any bytes.
std::string shown (const Json&);

/// "at least 1e-9", "from 0 to 1".
std::string rangeText (const Interval&);

/// Reads a number, or says what is wrong with it.
std::variant<Number, std::string> readNumber (const Json&);

/// Puts the assignments of a flat graph into its nodes' params: kinds, choices, shapes and ranges. Units are looked at
/// by unit_check, which knows what generic nodes carry.
void readParams (Flat&);

}   // namespace tactus::plan
