// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/node/catalogue.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <string>
#include <string_view>

namespace tactus::host
{

/// A number with the unit it was typed in, as the file keeps it: "0.4 mm" stays "0.4 mm".
struct QuantityText
{
    double number = 0.0;   ///< the number before the unit
    std::string unit;      ///< "mm"; empty for plain SI
    double scale = 1.0;    ///< SI per unit

    double si() const noexcept { return number * scale; }

    /// Another value in the same unit, rounded to three digits.
    QuantityText moved (double to_si) const;

    /// Another value in the same unit, to twelve digits.
    QuantityText exactly (double to_si) const;

    Json toJson() const;   ///< a plain number if there is no unit
    std::string toText() const;
};

/// The same value with the most readable prefix, such as 100 um for 0.0001 m, if it has no unit yet and the unit of the port takes prefixes.
QuantityText withBestPrefix (QuantityText, const PortSheet&);

/// A unit as people read it: "µm" for the "um" of files, and "N·s/m" for "N*s/m".
std::string unitShown (const std::string& unit);

/// A text as files have it: with "*" for each "·" and "u" for each "µ", so that what is shown can be typed.
std::string unitWritten (std::string text);

/// A value in SI units as people read it: "100 µm", "2.5 N". Six digits, of a whole number all. For the units "1" and "", only the number.
std::string shownQuantity (double si, std::string_view symbol);

/// Rounds to significant digits.
double rounded (double, int digits = 3);

/// Reads a param's value from a file or from what the user typed. Fails if the unit is wrong or the value is out of the hard range.
Result<QuantityText> readQuantity (const Json&, const PortSheet&);

/// The same of what was typed over a value that is shown: a number without a unit is in the unit shown.
Result<QuantityText> readTyped (const std::string& typed, const QuantityText& shown, const PortSheet&);

/// The SI value of a param, or `fallback` if it cannot be read.
double siOf (const Json&, const PortSheet&, double fallback = 0.0);

}   // namespace tactus::host
