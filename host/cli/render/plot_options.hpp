// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "figure_size.hpp"

#include <limits>
#include <string>

namespace tactus::host
{

/// The options for a plot of a recording.
struct PlotOptions : FigureSize
{
    std::string file;      ///< "": no plot
    std::string over;      ///< the port of the x axis; "": time
    double from_s = 0.0;   ///< the first and the last time
    double until_s = std::numeric_limits<double>::infinity();

    void addTo (const Command&);

    /// Sets the size from the options. Throws UsageError.
    void finish();
};

}   // namespace tactus::host
