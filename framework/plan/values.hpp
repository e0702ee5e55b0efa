// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/flat/flat.hpp>

#include <tactus/text/result.hpp>
#include <tactus/text/units.hpp>

namespace tactus::plan
{

/// A number in a file: plain, or text with a unit. Without a unit it is in SI and fits any dimension.
struct Number
{
    double value = 0.0;
    std::optional<Dimension> dimension;
    bool angular = false;   ///< written in radians or degrees
};

/// True if the number counts radians but cycles are required: "6 rad/s" for 1 Hz.
bool miscounts (const Number&, const UnitRule&) noexcept;

/// The message text for that case.
std::string miscount (const Json&, const UnitRule&);

/// A value as it was written, truncated if it is long. Text from the command line may contain any bytes.
std::string shown (const Json&);

/// "at least 1e-9", "from 0 to 1".
std::string rangeText (const Interval&);

/// True if a value of a parameter lies more than ten times beyond its usual range: above ten times its upper end, or below a tenth of its
/// lower end. 0 means none, and a number without a unit may be anything, so neither is far.
bool isFarFromUsual (const PortSheet&, double) noexcept;

/// Reads a number. An error has neither a location nor a remedy, only a text such as "it is not a finite number".
Result<Number> readNumber (const Json&);

/// Adds the values of a node's params to Flat::values, with the defaults of the datasheet. The size of its lists must be known.
void addValues (FlatNode&, Flat&);

/// Stores the assignments of a flat graph in the params of its nodes, and checks kinds, choices, shapes and ranges. unit_check
/// checks the units, because it knows which units generic nodes carry.
void readParams (Flat&);

}   // namespace tactus::plan
