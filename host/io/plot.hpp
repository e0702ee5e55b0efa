// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "colours.hpp"
#include <tactus/text/result.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

// All members have default initialisers, so that designated initialisers may leave them out without a warning.

/// The quantity of an axis. The data are in the SI unit, and the plot picks the prefix: "position", "m" may become "position (mm)".
struct Quantity
{
    std::string name {};
    std::string unit {};   // "m", "N*s/m"; "" or "1" for ratios
};

struct Series
{
    enum class Style
    {
        line,
        points
    };

    std::string label {};             // text in the legend; empty: not listed
    std::vector<double> x {}, y {};   // of equal length; nan and inf are gaps
    std::optional<Colour> colour {};
    Style style = Style::line;
};

/// One panel. The first series without a colour gets the colour of the quantity on the y axis; each further one gets the next
/// colour of the palette.
struct Axes
{
    std::string title {};
    Quantity x {}, y {};
    std::vector<Series> series {};
};

/// Panels from top to bottom. Neighbours with the same x quantity share its range, with labels only under the last one.
struct Figure
{
    std::string title {};
    std::vector<Axes> panels {};
    int width = 1600;   // pixels; text and lines scale with it, as if printed 800 points wide
    int height = 0;     // 0: depends on the number of panels
};

/// Draws the figure in print quality on white and writes it as PNG, completely or not at all. Needs no display. [main
/// thread], or any thread while a juce::ScopedJuceInitialiser_GUI exists.
///
/// Error ids: plot/no_panels, plot/ragged_series, plot/size, output/unwritable.
[[nodiscard]] Result<> writePng (const Figure& figure, const std::filesystem::path& path);

}   // namespace tactus::host
