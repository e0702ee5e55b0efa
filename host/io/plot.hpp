// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/io/colours.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

// Members have initialisers, empty ones too, so that a designated initialiser may leave them out without a warning.

/// What an axis shows. Data are in the SI unit; the plot picks the prefix: "position", "m" may become "position (mm)".
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

    std::string label {};             // for the legend; empty: none
    std::vector<double> x {}, y {};   // of one length; nan and inf are gaps
    std::optional<Colour> colour {};
    Style style = Style::line;
};

/// One panel. A series without a colour gets that of the quantity on the y axis, further ones the next of the palette.
struct Axes
{
    std::string title {};
    Quantity x {}, y {};
    std::vector<Series> series {};
};

/// Panels from top to bottom. Neighbours with the same x quantity share its range, and its labels under the last of them.
struct Figure
{
    std::string title {};
    std::vector<Axes> panels {};
    int width = 1600;   // pixels; text and lines grow with it, as if printed 800 points wide
    int height = 0;     // 0: as the number of panels wants
};

/// Draws the figure as a paper could print it, on white, and writes it as PNG; the file appears whole or not at all.
/// Needs no display. [main thread], or any thread while a juce::ScopedJuceInitialiser_GUI lives.
///
/// Ids of errors: plot/no_panels, plot/ragged_series, plot/size, output/unwritable.
[[nodiscard]] tl::expected<void, Error> writePng (const Figure& figure, const std::filesystem::path& path);

}   // namespace tactus::host
