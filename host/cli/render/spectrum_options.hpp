// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "figure_size.hpp"

#include <host/tools/figures/plot.hpp>
#include <host/tools/figures/spectrogram.hpp>
#include <tactus/plan/plan.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// The options for a spectrum: which port to analyse, how, and where to write the result.
struct SpectrumOptions : FigureSize
{
    std::string file, port;   ///< port "": the input of the first sink
    double up_to_hz = 1000.0, decibels = 60.0;

    void addTo (const Command&);

    /// Checks the name of the file, and computes the size. Throws UsageError.
    void finish();

    bool isTable() const { return file.ends_with (".csv"); }

    /// The ports to record: none for the inputs of the sinks.
    std::vector<std::string> records() const { return port.empty() ? std::vector<std::string> {} : std::vector { port }; }

    /// Writes the map as a figure with one panel. The command ends if that fails.
    void write (const std::string& title, const Quantity& x, const Quantity& y, HeatMap) const;

    /// Writes a table: a row for each value of x, and a column for each value of y. The names in the header contain the units.
    void writeTable (const std::string& x, const std::vector<double>& rows, const std::vector<std::string>& columns,
                     const std::vector<std::vector<double>>& values) const;

    /// Writes a spectrogram, as a figure or as a table. `x`: the quantity on the horizontal axis, such as time in s.
    void write (const std::string& title, const Quantity& x, const Spectrogram&, const std::string& unit) const;
};

/// All samples of one port, as a run records them.
class PortSamples
{
public:
    /// The command ends if nothing is recorded. If several ports are recorded, takes the first one.
    PortSamples (const std::vector<Tap>&, double rate_hz);

    /// Adds the samples of the tick that the plan has run.
    void frame (const Plan&);

    const Components& all() const noexcept { return components; }
    double rate() const noexcept { return rate_hz; }   ///< samples per second
    const std::string& name() const noexcept { return port; }
    const std::string& component() const noexcept { return first; }   ///< the name of the first component
    const std::string& unit() const noexcept { return si; }

private:
    std::vector<std::size_t> taps;
    int per_tick = 1;
    double rate_hz;
    std::string port, first, si;
    Components components;
};

}   // namespace tactus::host
