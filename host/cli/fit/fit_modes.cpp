// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

namespace tactus::host
{

void addFitModes (const Command& fit)
{
    const auto modes =
        addFitKind (fit, FitKind::modes, "Fit the modes of vibration.modal to a ring",
                    "Finds the number of tones, and the frequency, decay and amplitude of each. The fit is good if only noise is\n"
                    "left. Amplitudes are those at the blow, in the unit of the recording; with --mass and --speed, those in the preset are in N.\n\n"
                    "Examples:\n"
                    "  tactus fit modes tap.csv -o bell.json --plot bell.png\n"
                    "  tactus fit modes bell.wav -o bell.json --column \"value=channel 2\"\n"
                    "  tactus fit modes tap.csv --from \"12 ms\" --to \"200 ms\" --mass \"20 g\" --speed \"0.3 m/s\" -o bell.json");
    modes.add ("from", "12 ms", "Start of the fitted part; default: after the largest value");
    modes.add ("to", "200 ms", "End of the fitted part; default: that of the recording, without most of the silence after the ring");
    modes.add ("blow", "10 ms", "Time of the blow, to which the amplitudes refer; default: where the half-wave with the largest value begins");
    modes.add ("mass", "20 g", "Mass of the tip, if the recording is in m/s2");
    modes.add ("speed", "0.3 m/s", "Speed of the blow");
    modes.add ("most", "", "Largest number of modes; default 20");
}

}   // namespace tactus::host
