// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>

#include <tactus/node/datasheet.hpp>
#include <tactus/text/quantity.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// The data of a small plot with units on its axes: a line through points, or a stem per point.
struct PlotData
{
    enum class Kind
    {
        line,
        stems
    };

    Kind kind = Kind::line;
    std::vector<double> x {}, y {};
    std::vector<bool> knots {};   ///< true for points that get a dot; may be empty
    std::string x_unit {}, y_unit {};
    Quantity quantity = Quantity::any;   ///< quantity of y, for the colour
};

void paintPlot (juce::Graphics&, juce::Rectangle<float>, const PlotData&, const Look&);

/// The curve of a law over the range a hand can reach.
PlotData plotOf (const Law&, const UnitRule& x, const UnitRule& y);
PlotData plotOf (const Curve&, const UnitRule& x, const UnitRule& y);

}   // namespace tactus::host
