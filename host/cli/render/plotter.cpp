// SPDX-License-Identifier: GPL-3.0-or-later
#include "plotter.hpp"

#include <host/cli/report.hpp>
#include <host/tools/figures/plot.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// The label of an axis: the quantity, or the tap's name if its quantity is unknown.
Quantity axisOf (const Tap& tap)
{
    return { tap.quantity == tactus::Quantity::any ? tap.name : std::string (name (tap.quantity)), tap.unit, tap.quantity == tactus::Quantity::state };
}

bool isSilent (const Axes& panel)
{
    return std::ranges::all_of (panel.series, [] (const Series& s) { return std::ranges::count (s.y, 0.0) == static_cast<std::ptrdiff_t> (s.y.size()); });
}
}   // namespace

Plotter::Plotter (const PlotOptions& o, const std::vector<Tap>& t, double rate, bool silent)
    : options (o), taps (t), rate_hz (rate), leave_out_silent (silent), columns (t.size())
{
    if (taps.empty()) fail ("record/nothing", "there is nothing to plot: the graph has no sink", "name ports with --record, as in --record drag.force");
    if (options.over.empty()) return;
    const auto found = std::ranges::find (taps, options.over, &Tap::name);
    if (found == taps.end())
        fail ("plot/not_recorded", "'" + options.over + "', which --over names, is not recorded", "add it to --record, or name a recorded port");
    over = found - taps.begin();
}

void Plotter::frame (std::span<const double> values)
{
    const double time = static_cast<double> (ticks++) / rate_hz;
    if (time < options.from_s || time > options.until_s) return;
    times.push_back (time);
    for (std::size_t i = 0; i < columns.size(); ++i)
        columns[i].push_back (values[i]);
}

void Plotter::draw (const std::string& title)
{
    if (times.empty()) fail ("plot/no_ticks", "there is nothing to plot: the run ends before --from", "choose a smaller --from, or a longer --duration");
    Figure figure { .title = title, .width = options.width, .height = options.height, .dpi = options.dpi };
    const auto& x = over < 0 ? times : columns[static_cast<std::size_t> (over)];
    Quantity x_axis { "time", "s" };
    if (over >= 0) x_axis = { taps[static_cast<std::size_t> (over)].name, taps[static_cast<std::size_t> (over)].unit };

    for (std::size_t i = 0; i < taps.size(); ++i)
    {
        if (static_cast<std::ptrdiff_t> (i) == over) continue;
        const auto y = axisOf (taps[i]);
        auto panel = std::ranges::find_if (figure.panels, [&] (const Axes& a) { return a.y.name == y.name && a.y.unit == y.unit; });
        if (panel == figure.panels.end())
        {
            figure.panels.push_back ({ .title = {}, .x = x_axis, .y = y, .series = {} });
            panel = std::prev (figure.panels.end());
        }
        panel->series.push_back ({ .label = taps[i].name, .x = x, .y = columns[i] });
    }
    if (leave_out_silent && ! std::ranges::all_of (figure.panels, isSilent)) std::erase_if (figure.panels, isSilent);
    orFail (writeFigure (figure, options.file));
}

}   // namespace tactus::host
