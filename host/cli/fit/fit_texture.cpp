// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_command.hpp"

namespace tactus::host
{

void addFitTexture (const Command& fit)
{
    const auto texture =
        addFitKind (fit, FitKind::texture, "Fit the models of texture.noise to vibrations of a dragged tool",
                    "Groups the rows by speed and force, and fits an autoregressive model to each group. White sensor noise is fitted, too, but is\n"
                    "not part of the texture.\n\n"
                    "Examples:\n"
                    "  tactus fit texture cloth.csv -o cloth.json --plot cloth.png\n"
                    "  tactus fit texture cloth.csv --speed \"0.1 m/s\" --force \"1 N\" --mass \"15 g\" -o cloth.json");
    texture.add ("speed", "0.1 m/s", "Speed of the tool, if it was not recorded; default 0.1 m/s");
    texture.add ("force", "1 N", "Normal force, if it was not recorded; default 1 N");
    texture.add ("mass", "15 g", "Mass of the tip, which turns acceleration into force; default 10 g, a guess");
    texture.add ("most", "", "Largest number of coefficients of a model; default 20");
}

}   // namespace tactus::host
