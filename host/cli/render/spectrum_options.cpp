// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrum_options.hpp"

#include <host/cli/report.hpp>
#include <tactus/file/csv.hpp>
#include <tactus/run/probe_ring.hpp>
#include <tactus/text/number_text.hpp>
#include <tactus/text/quote.hpp>

#include <algorithm>

namespace tactus::host
{

void SpectrumOptions::addTo (const Command& command)
{
    command.addOption ("-o,--out", file, std::string ("The file to write: ") + figure_kinds + " for a figure, .csv for a table").required();
    command.addOption ("--port", port, "The port to analyse, such as drag.force or drag.force.x; default: the input of the first motor");
    command.addOption ("--up-to", up_to_hz, "The highest frequency to show in Hz; default: 1000, the highest that skin feels").check (finiteWithin (1.0, 1e6));
    command.addOption ("--decibels", decibels, "Range of the colours below the strongest frequency, in dB; default: 60").check (finiteWithin (1.0, 300.0));
    addSize (command);
}

void SpectrumOptions::finish()
{
    if (! isTable() && ! isFigureFile (file)) throw UsageError ("--out", quotePath (file) + " should end in " + figure_kinds + ", or in .csv");
    readSize();
}

void SpectrumOptions::write (const std::string& title, const Quantity& x, const Quantity& y, HeatMap map) const
{
    const Axes panel { .x = x, .y = y, .map = std::move (map) };
    orFail (writeFigure ({ .title = title, .panels = { panel }, .width = width, .height = height, .dpi = dpi }, file));
}

void SpectrumOptions::writeTable (const std::string& x, const std::vector<double>& rows, const std::vector<std::string>& columns,
                                  const std::vector<std::vector<double>>& values) const
{
    std::vector<std::string> names { x };
    names.insert (names.end(), columns.begin(), columns.end());
    auto table = orFail (TableWriter::create (file, names));
    std::vector<double> row;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        row.assign (1, rows[i]);
        row.insert (row.end(), values[i].begin(), values[i].end());
        orFail (table.row (row));
    }
    orFail (table.commit());
}

void SpectrumOptions::write (const std::string& title, const Quantity& x, const Spectrogram& s, const std::string& unit) const
{
    if (! isTable()) return write (title, x, { "frequency", "Hz" }, heatMapOf (s, unit, decibels));
    std::vector<std::string> columns;
    for (std::size_t i = 0; i < s.columns.front().size(); ++i)
        columns.push_back (numberText (static_cast<double> (i) * s.step_hz) + " Hz (" + (unit.empty() ? "1" : unit) + ")");
    writeTable (x.name + " (" + x.unit + ")", s.at, columns, s.columns);
}

PortSamples::PortSamples (const std::vector<Tap>& all, double rate) : rate_hz (rate)
{
    if (all.empty()) fail ("record/nothing", "there is nothing to analyse: the graph has no motor", "name a port with --port, as in --port drag.force");
    first = all.front().name;
    si = all.front().unit;
    const bool is_component = first.ends_with (".x") || first.ends_with (".y") || first.ends_with (".z");
    port = is_component ? first.substr (0, first.size() - 2) : first;
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].name == first || (is_component && isPartOf (all[i].name, port)))
        {
            taps.push_back (i);
            per_tick = std::max (per_tick, all[i].per_tick);
        }
    if (taps.size() == 1) port = first;
    rate_hz *= per_tick;
    components.resize (taps.size());
}

void PortSamples::frame (const Plan& plan)
{
    for (std::size_t i = 0; i < taps.size(); ++i)
        for (int k = 0; k < per_tick; ++k)
            components[i].push_back (plan.taps()[taps[i]].sample (k, per_tick));
}

}   // namespace tactus::host
