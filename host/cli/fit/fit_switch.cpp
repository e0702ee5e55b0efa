// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

namespace tactus::host
{

void addFitSwitch (const Command& fit)
{
    const auto key =
        addFitKind (fit, FitKind::key_switch, "Fit a passive key to the force of a key switch, pressed and released",
                    "Record down to the stop and back up, one row per reading. The graph follows both ways and keeps the click, and never\n"
                    "returns more energy than it takes. docs/import.md says how.\n\n"
                    "Examples:\n"
                    "  tactus fit switch key.csv -o key.json --plot key.png\n"
                    "  tactus fit switch key.csv --backlash \"20 um\" -o key.json");
    key.add ("tolerance", "10 mN", "Largest distance between the recording and the straight lines that replace it; default 10 mN");
    key.add ("stiffness", "10 N/mm", "Stiffness with which the force changes when the finger reverses; default 10 N/mm");
    key.add ("backlash", "20 um", "Backlash of the meter: on the way up, the key is this much deeper than recorded; default: none");
}

}   // namespace tactus::host
