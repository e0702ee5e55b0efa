// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plot_options.hpp"

#include <tactus/plan/plan.hpp>

#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// Collects the recording of a run and draws it: one panel per quantity, over time or over one of the taps.
class Plotter
{
public:
    /// The command ends if the tap of the x axis is not recorded. With `leave_out_silent`, quantities that are 0 throughout, such as the
    /// torque of a sink without a wire, are left out.
    Plotter (const PlotOptions&, const std::vector<Tap>&, double rate_hz, bool leave_out_silent);

    /// Adds the values of the next tick.
    void frame (std::span<const double> values);
    void draw (const std::string& title);

private:
    const PlotOptions& options;
    const std::vector<Tap>& taps;
    std::ptrdiff_t over = -1;   // index of the tap; -1: time
    double rate_hz;
    bool leave_out_silent;
    std::size_t ticks = 0;
    std::vector<double> times;   // of the values in the columns
    std::vector<std::vector<double>> columns;
};

}   // namespace tactus::host
