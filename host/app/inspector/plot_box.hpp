// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <framework/datasheet.hpp>
#include <framework/quantity.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// A small figure: a line through points, or a stem at each, with axes in units.
struct Figure
{
    enum class Kind
    {
        line,
        stems
    };

    Kind kind = Kind::line;
    std::vector<double> x, y;
    std::vector<bool> knots;   ///< which points get a dot; none if empty
    std::string x_unit, y_unit;
    Quantity quantity = Quantity::any;   ///< of y, for its colour
};

void paintFigure (juce::Graphics&, juce::Rectangle<float>, const Figure&, const Look&);

/// A law over what a hand reaches of it.
Figure figureOf (const Law&, const UnitRule& x, const UnitRule& y);
Figure figureOf (const Curve&, const UnitRule& x, const UnitRule& y);

}   // namespace tactus::host
