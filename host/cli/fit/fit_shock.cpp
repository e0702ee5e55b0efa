// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

namespace tactus::host
{

void addFitShock (const Command& fit)
{
    const auto shock = addFitKind (fit, FitKind::shock, "Fit the spring and damper of shock.hunt_crossley to a recorded impact",
                                   "The loop of the fitted force over the recorded depth has exactly the area of the recorded loop, because the hand\n"
                                   "feels the lost energy more than the shape of the loop. Depth and force are positive inside the object.\n\n"
                                   "Examples:\n"
                                   "  tactus fit shock tap_on_steel.csv -o tap_on_steel.json\n"
                                   "  tactus fit shock loop.csv --mass \"30 g\" -o rubber.json --plot rubber.png");
    shock.add ("mass", "50 g", "The mass that rebounded; required if the recording has no times. Default: impulse divided by change of speed");
}

}   // namespace tactus::host
