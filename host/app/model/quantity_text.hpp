// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/catalogue.hpp>
#include <framework/json.hpp>

#include <string>
#include <variant>

namespace tactus::host
{

/// A number as people type it, and as a file keeps it: "0.4 mm" stays "0.4 mm".
struct QuantityText
{
    double number = 0.0;   ///< before the unit
    std::string unit;      ///< "mm"; empty for plain SI
    double scale = 1.0;    ///< SI per unit

    double si() const noexcept { return number * scale; }

    /// In the same unit, with as many digits as a hand can mean.
    QuantityText moved (double to_si) const;

    Json toJson() const;   ///< a plain number where there is no unit
    std::string toText() const;
};

/// Reads what a file holds or somebody typed, for a param; or says what is wrong with it: the unit, or the hard range.
std::variant<QuantityText, std::string> readQuantity (const Json&, const PortSheet&);

}   // namespace tactus::host
