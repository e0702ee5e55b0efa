// SPDX-License-Identifier: GPL-3.0-or-later
#include "plotter.hpp"
#include "report.hpp"

#include <host/io/plot.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
/// The label of an axis: the quantity, or the tap's name if its quantity is unknown.
Quantity axisOf (const Tap& tap)
{
    return { tap.quantity == tactus::Quantity::any ? tap.name : std::string (name (tap.quantity)), tap.unit };
}

bool isSilent (const Axes& panel)
{
    return std::ranges::all_of (panel.series, [] (const Series& s) { return std::ranges::count (s.y, 0.0) == static_cast<std::ptrdiff_t> (s.y.size()); });
}
}   // namespace

Plotter::Plotter (std::string f, const std::vector<Tap>& t, const std::string& over_name, double rate, bool silent)
    : file (std::move (f)), taps (t), rate_hz (rate), leave_out_silent (silent), columns (t.size())
{
    if (taps.empty()) fail ("record/nothing", "there is nothing to plot: the graph has no sink", "name ports with --record, as in --record drag.force");
    if (over_name.empty()) return;
    const auto found = std::ranges::find (taps, over_name, &Tap::name);
    if (found == taps.end())
        fail ("plot/not_recorded", "'" + over_name + "', which --over names, is not recorded", "add it to --record, or name a recorded port");
    over = found - taps.begin();
}

void Plotter::frame (std::span<const double> values)
{
    for (std::size_t i = 0; i < columns.size(); ++i)
        columns[i].push_back (values[i]);
}

void Plotter::draw (const std::string& title)
{
    Figure figure { .title = title };
    std::vector<double> times (columns[0].size());
    for (std::size_t k = 0; k < times.size(); ++k)
        times[k] = static_cast<double> (k) / rate_hz;
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
    orFail (writePng (figure, file));
}

}   // namespace tactus::host
