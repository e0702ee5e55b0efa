// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

namespace tactus::host
{

void addFitBlade (const Command& fit)
{
    const auto blade =
        addFitKind (fit, FitKind::blade, "Fit cut.blade to a recorded cut",
                    "Finds the stiffness before the sample bursts, the force at which it bursts, and the toughness from the cutting force. If the\n"
                    "recording ends before the burst, it gives only lower bounds for the two forces, and the verdict is poor.\n\n"
                    "Example:\n"
                    "  tactus fit blade potato.csv --width \"20 mm\" -o potato.json --plot potato.png");
    blade.add ("width", "20 mm", "Length of the edge inside the sample; default 20 mm, a guess");
    blade.add ("touch", "0.2 mm", "Depth in the recording at the touch of the sample; default: 0, unless the force begins elsewhere");
}

}   // namespace tactus::host
