// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

namespace tactus::host
{

void addFitGrating (const Command& fit)
{
    const auto grating =
        addFitKind (fit, FitKind::grating, "Fit texture.grating to a scanned profile of ridges",
                    "Finds the period and the amplitude of each harmonic. The preset has one texture.grating per harmonic, and renders the force on a tool\n"
                    "without friction: load times slope.\n\n"
                    "Example:\n"
                    "  tactus fit grating scan.csv --load \"0.5 N\" -o ridges.json --plot ridges.png");
    grating.add ("load", "0.5 N", "Normal force of the tool in the preset; default 1 N");
    grating.add ("most", "", "Largest number of harmonics; default 8");
}

}   // namespace tactus::host
