// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "osc_client.hpp"

#include <string>

namespace tactus::host
{

/// The options of `tactus probe --trigger`.
struct TriggerOptions
{
    std::string watched, edge = "rising";
    double level = 0.0;
    int before = 100, after = 400;   // ticks
    double duration_s = 0.0;         // how long to wait; 0: until Ctrl-C
};

/// Waits for the edge and prints the window around it as CSV, with t = 0 at the edge.
void probeTriggered (OscClient&, const std::string& port, const TriggerOptions&);

}   // namespace tactus::host
