// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

#include <host/cli/commands.hpp>

namespace tactus::host
{

void addFit (const Command& app)
{
    const auto command = app.add ("fit", "Fit a model to a recording, with 95 % intervals, and write a preset with it");
    command.requireCommand();
    command.footer ("Every fit prints its parameters with 95 % intervals, its residual, the residual on a part of the recording that was left out of the fit,\n"
                    "and a verdict: good or poor. If it is poor, the fit says what is missing. docs/fit.md says how to record.\n\n"
                    "Examples:\n"
                    "  tactus fit friction strokes.csv -o wood.json --plot wood.png\n"
                    "  tactus fit modes tap.csv -o bell.json --json");
    addFitFriction (command);
    addFitModes (command);
    addFitTexture (command);
    addFitGrating (command);
    addFitBlade (command);
    addFitCurve (command);
    addFitSwitch (command);
    addFitShock (command);
}

}   // namespace tactus::host
