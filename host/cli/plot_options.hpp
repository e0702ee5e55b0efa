// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/command_line/command.hpp>

#include <limits>
#include <string>

namespace tactus::host
{

/// What to plot of a recording, and how large.
struct PlotOptions
{
    std::string file;      ///< "": no plot
    std::string over;      ///< the port of the x axis; "": time
    double from_s = 0.0;   ///< the first and the last time
    double until_s = std::numeric_limits<double>::infinity();
    int width = 1600, height = 0;   ///< in pixels; a height of 0 depends on the number of panels
    double dpi = 0.0;               ///< as in Figure

    void addTo (const Command&);

    /// Sets the size from the options. Throws UsageError.
    void finish();

private:
    std::string size;
    double dots_per_inch = 192.0;
};

}   // namespace tactus::host
