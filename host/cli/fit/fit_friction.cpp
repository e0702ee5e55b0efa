// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

namespace tactus::host
{

void addFitFriction (const Command& fit)
{
    const auto friction =
        addFitKind (fit, FitKind::friction, "Fit friction.elasto_plastic to strokes back and forth",
                    "Finds mu, d_max (how far the contact stretches before it slides), the adhesion function and the stiffness. Record at least three\n"
                    "slow strokes back and forth, each several times longer than d_max.\n\n"
                    "Examples:\n"
                    "  tactus fit friction strokes.csv -o wood.json --plot wood.png\n"
                    "  tactus fit friction strokes.txt --column \"position=Position [mm]\" --load \"2 N\" -o wood.json");
    friction.add ("load", "2 N", "Normal force, if it was not recorded; default: 1 N, so that mu is the force while sliding in N");
}

}   // namespace tactus::host
