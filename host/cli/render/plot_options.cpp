// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_options.hpp"

#include <host/tools/figures/plot.hpp>
#include <tactus/text/quote.hpp>

namespace tactus::host
{

void PlotOptions::addTo (const Command& command)
{
    const auto plot = command.addOption ("--plot", file, std::string ("Plot the recording into a ") + figure_kinds);
    command.addOption ("--over", over, "Plot against this recorded port instead of against time").needs (plot);
    command.addOption ("--from", from_s, "The time at which the plot begins, in s").check (finiteWithin (0.0, 1e9)).needs (plot);
    command.addOption ("--until", until_s, "The time at which the plot ends, in s").check (finiteWithin (1e-9, 1e9)).needs (plot);
    for (const auto [paper, fineness] = addSize (command); const auto& option : { paper, fineness })
        option.needs (plot);
}

void PlotOptions::finish()
{
    if (file.empty()) return;
    if (! isFigureFile (file)) throw UsageError ("--plot", quotePath (file) + " should end in " + figure_kinds);
    if (! (from_s < until_s)) throw UsageError ("--until", "it must be after --from");
    readSize();
}

}   // namespace tactus::host
