// SPDX-License-Identifier: MIT
#pragma once

#include "axis.hpp"
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
    bool whole = false;    // only whole numbers have a meaning, as for states: no ticks between them
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

/// Values over a plane as colours, from dark (low) to bright (high). A bar next to the panel shows the scale.
struct HeatMap
{
    Extent x {}, y {};   // from edge to edge
    std::size_t columns = 0, rows = 0;
    std::vector<double> values {};   // column by column, from low y to high y; nan is a gap
    Quantity colour {};              // a unit that begins with "dB" gets no prefix
    Extent range {};                 // of the darkest and the brightest colour
};

/// One panel. The first series without a colour gets the colour of the quantity on the y axis; each further one gets the next
/// colour of the palette.
struct Axes
{
    std::string title {};
    Quantity x {}, y {};
    std::vector<Series> series {};
    std::optional<HeatMap> map {};   // drawn below the series
    Extent x_shown {}, y_shown {};   // the axes reach at least from end to end of these
};

/// Panels from top to bottom. Neighbours with the same x quantity share its range, with labels only under the last one.
struct Figure
{
    std::string title {};
    std::vector<Axes> panels {};
    int width = 1600;   // pixels
    int height = 0;     // pixels; 0: depends on the number of panels
    double dpi = 0.0;   // pixels per inch. Text is 10.5 points high on paper. 0: 800 units of 1/96 inch fit into the width
};

/// The kinds of file that writeFigure can write.
inline constexpr const char* figure_kinds = ".png, .svg or .pdf";
bool isFigureFile (const std::filesystem::path& path);

/// Draws the figure on white and writes it as PNG, SVG or PDF, as the name of the file ends, completely or not at all. The file states the size on
/// paper. SVG and PDF hold lines and outlines, and no fonts. Needs no display. [main thread], or any thread while a
/// juce::ScopedJuceInitialiser_GUI exists.
///
/// Error ids: plot/kind, plot/no_panels, plot/ragged_series, plot/ragged_map, plot/size, output/unwritable.
[[nodiscard]] Result<> writeFigure (const Figure& figure, const std::filesystem::path& path);

}   // namespace tactus::host
