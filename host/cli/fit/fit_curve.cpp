// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

#include <host/cli/amount.hpp>

namespace tactus::host
{

void addFitCurve (const Command& fit)
{
    const auto curve =
        addFitKind (fit, FitKind::curve, "Fit a curve of deform.surface to a recorded indentation",
                    "The curve never falls and never pulls. It lies halfway between the way in and the way out, so a node that plays it loses no\n"
                    "energy; the command prints the energy that the recording lost. Record slowly, and only along the normal.\n\n"
                    "Examples:\n"
                    "  tactus fit curve liver.csv -o liver.json --plot liver.png\n"
                    "  tactus fit curve switch.csv --depth x_um --depth-unit \"1 um\" --force force_gf --force-unit \"9.80665 mN\" -o switch.json");
    for (const std::string role : { "depth", "force" })
    {
        curve.command.addOption (
            "--" + role, [options = curve.options, role] (const std::string& name) { options->settings.columns.names[role] = name; },
            "Name of the column of " + role + "s; the same as --column " + role + "=NAME");
        const std::string unit = role == "depth" ? "m" : "N", example = role == "depth" ? "1 um" : "1 mN";
        curve.command.addOption (
            "--" + role + "-unit",
            [options = curve.options, role, unit, example] (const std::string& text) {
                options->settings.columns.units[role] = readAmount ("--" + role + "-unit", text, unit.c_str(), example.c_str());
            },
            "What 1 in this column means; the same as --unit " + role + "=…");
    }
    curve.add ("touch", "0.2 mm", "Depth in the recording at the touch of the object; default: 0, unless the force begins elsewhere");
    curve.add ("points", "", "Number of points of the curve; default 20");
    curve.add ("mu", "", "Drag over push while the tool slides; default 0.3, a guess");
    curve.add ("ratio", "", "Sideways deflection at which the tool slides, over its depth; default 0.45, a guess");
}

}   // namespace tactus::host
