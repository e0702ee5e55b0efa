// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

namespace tactus::host
{

void addFitModes (const Command& fit)
{
    const auto modes =
        addFitKind (fit, FitKind::modes, "Fit the modes of vibration.modal to a ring",
                    "Finds the number of tones, and the frequency, decay and amplitude of each. Two tones that are closer than their bandwidths count as\n"
                    "one. Amplitudes are those at the blow, in the unit of the recording; with --mass and --speed, those in the preset are in N.\n\n"
                    "Examples:\n"
                    "  tactus fit modes tap.csv -o bell.json --plot bell.png\n"
                    "  tactus fit modes tap.csv --from \"12 ms\" --to \"200 ms\" --mass \"20 g\" --speed \"0.3 m/s\" -o bell.json");
    modes.addSignedAmount ("--from", "s", "12 ms", "Start of the fitted part; default: after the largest value",
                           [] (FitSettings& s, double t) { s.from = t; });
    modes.addSignedAmount ("--to", "s", "200 ms", "End of the fitted part; default: where the ring has fallen to a twentieth",
                           [] (FitSettings& s, double t) { s.to = t; });
    modes.addSignedAmount ("--blow", "s", "10 ms",
                           "Time of the blow, to which the amplitudes refer; default: where the half-wave with the largest value begins",
                           [] (FitSettings& s, double t) { s.blow = t; });
    modes.addAmount ("--mass", "kg", "20 g", "Mass of the tip, if the recording is in m/s2", [] (FitSettings& s, double kg) { s.mass = kg; });
    modes.addAmount ("--speed", "m/s", "0.3 m/s", "Speed of the blow", [] (FitSettings& s, double speed) { s.speed = speed; });
    modes.command.addOption ("--most", modes.options->settings.most, "Largest number of modes; default 8").check (within (1, 20));
}

}   // namespace tactus::host
