// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

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
    auto& settings = curve.options->settings;
    for (const std::string role : { "depth", "force" })
    {
        curve.command.addOption (
            "--" + role, [options = curve.options, role] (const std::string& name) { options->settings.columns.names[role] = name; },
            "Name of the column of " + role + "s; the same as --column " + role + "=NAME");
        curve.addAmount ("--" + role + "-unit", role == "depth" ? "m" : "N", role == "depth" ? "1 um" : "1 mN",
                         "What 1 in this column means; the same as --unit " + role + "=…",
                         [role] (FitSettings& s, double factor) { s.columns.units[role] = factor; });
    }
    curve.addSignedAmount ("--touch", "m", "0.2 mm", "Depth in the recording at the touch of the object; default: 0, unless the force begins elsewhere",
                           [] (FitSettings& s, double metres) { s.touch = metres; });
    curve.command.addOption ("--points", settings.points, "Number of points of the curve; default 20").check (within (2, 1000));
    curve.command.addOption ("--mu", settings.mu, "Drag over push while the tool slides; default 0.3, a guess").check (finiteWithin (0.0, 10.0));
    curve.command.addOption ("--ratio", settings.ratio, "Sideways deflection at which the tool slides, over its depth; default 0.45, a guess")
        .check (finiteWithin (1e-6, 1e3));
}

}   // namespace tactus::host
