// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

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
    /// `over` names the tap for the x axis; empty: time. The command ends if that tap is not recorded. With
    /// `leave_out_silent`, quantities that are 0 throughout, such as the torque of a sink without a wire, are left out.
    Plotter (std::string file, const std::vector<Tap>&, const std::string& over, double rate_hz, bool leave_out_silent);

    void frame (std::span<const double> values);
    void draw (const std::string& title);

private:
    std::string file;
    const std::vector<Tap>& taps;
    std::ptrdiff_t over = -1;   // index of the tap; -1: time
    double rate_hz;
    bool leave_out_silent;
    std::vector<std::vector<double>> columns;
};

}   // namespace tactus::host
