// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/plan/plan.hpp>

#include <span>
#include <string>
#include <vector>

namespace tactus::host
{

/// Keeps what a run records and draws it: one panel a quantity, over time or over one of the taps.
class Plotter
{
public:
    /// `over` names the tap for the x axis; empty is time. A name that is not recorded ends the command. Quantities that
    /// stay 0 throughout may be left out: a sink's torque that nothing is wired to.
    Plotter (std::string file, const std::vector<Tap>&, const std::string& over, double rate_hz, bool leave_out_silent);

    void frame (std::span<const double> values);
    void draw (const std::string& title);

private:
    std::string file;
    const std::vector<Tap>& taps;
    std::ptrdiff_t over = -1;   // index of the tap, or time
    double rate_hz;
    bool leave_out_silent;
    std::vector<std::vector<double>> columns;
};

}   // namespace tactus::host
