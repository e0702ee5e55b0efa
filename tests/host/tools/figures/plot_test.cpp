// SPDX-License-Identifier: GPL-3.0-or-later
#include <host/tools/figures/plot.hpp>

#include "support/temporary_folder.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <juce_graphics/juce_graphics.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <utility>

using namespace tactus::host;

namespace
{
Series sine (std::string label, double amplitude)
{
    Series series { .label = std::move (label) };
    for (int k = 0; k < 400; ++k)
    {
        series.x.push_back (k * 1e-3);
        series.y.push_back (amplitude * std::sin (0.05 * k));
    }
    return series;
}

Axes forceOverTime (std::vector<Series> series)
{
    return { .x = { "time", "s" }, .y = { "force", "N" }, .series = std::move (series) };
}

juce::Image draw (const Figure& figure)
{
    const TemporaryFolder folder;
    const auto written = writeFigure (figure, folder / "plot.png");
    INFO ((written ? "" : describe (written.error())));
    REQUIRE (written.has_value());
    return juce::PNGImageFormat::loadFrom (juce::File ((folder / "plot.png").string()));
}

int pixelsOf (const juce::Image& image, Colour colour)
{
    int count = 0;
    for (int y = 0; y < image.getHeight(); ++y)
        for (int x = 0; x < image.getWidth(); ++x)
            if (image.getPixelAt (x, y) == juce::Colour (colour.red, colour.green, colour.blue))
                ++count;
    return count;
}

std::string errorOf (const Figure& figure, const std::filesystem::path& path)
{
    const auto written = writeFigure (figure, path);
    return written ? "" : written.error().id;
}
}   // namespace

TEST_CASE ("plot: a quantity has the same colour in print as on its port", "[host][io][plot]")
{
    CHECK (colourFor ("force") == Colour { 0xD5, 0x5E, 0x00 });
    CHECK (colourFor ("position") == Colour { 0x56, 0xB4, 0xE9 });
    CHECK (colourFor ("something else") == colourFor ("gain"));

    const auto image = draw ({ .panels = { forceOverTime ({ sine ("", 1.0) }) } });
    CHECK (pixelsOf (image, colourFor ("force")) > 1000);
}

TEST_CASE ("plot: seven traces in one panel have seven colours, starting with the quantity's own", "[host][io][plot]")
{
    for (const auto* quantity : { "force", "position", "gain", "state" })
    {
        std::set<int> colours;
        for (std::size_t n = 0; n < 7; ++n)
        {
            const auto colour = colourFor (quantity, n);
            colours.insert (colour.red << 16 | colour.green << 8 | colour.blue);
        }
        CHECK (colours.size() == 7);
    }
    CHECK (colourFor ("force", 0) == colourFor ("force"));
}

TEST_CASE ("plot: yellow is darkened on paper, other colours are not", "[host][io][plot]")
{
    CHECK_FALSE (onPaper (colourFor ("hit")) == colourFor ("hit"));
    for (const auto* quantity : { "position", "force", "value", "gain", "energy", "torque", "rate" })
        CHECK (onPaper (colourFor (quantity)) == colourFor (quantity));
    CHECK_FALSE (onPaper ({ 255, 255, 255 }) == Colour { 255, 255, 255 });
}

TEST_CASE ("plot: a figure has the given size, or one that suits its panels", "[host][io][plot]")
{
    const auto axes = forceOverTime ({ sine ("x", 1.0), sine ("y", 2.0) });

    const auto image = draw ({ .panels = { axes }, .width = 700, .height = 400 });
    CHECK (image.getWidth() == 700);
    CHECK (image.getHeight() == 400);

    const auto one = draw ({ .panels = { axes } });
    const auto four = draw ({ .panels = { axes, axes, axes, axes } });
    CHECK (one.getWidth() == 1600);
    CHECK (four.getHeight() > one.getHeight());
}

TEST_CASE ("plot: equal figures give equal files", "[host][io][plot]")
{
    const TemporaryFolder folder;
    const Figure figure { .title = "Twice", .panels = { forceOverTime ({ sine ("x", 1.0) }) } };
    REQUIRE (writeFigure (figure, folder / "one.png").has_value());
    REQUIRE (writeFigure (figure, folder / "two.png").has_value());

    CHECK (folder.textOf ("one.png") == folder.textOf ("two.png"));
}

TEST_CASE ("plot: a one-sample peak among a million samples is visible", "[host][io][plot]")
{
    Series series;
    for (int k = 0; k < 1'000'000; ++k)
    {
        series.x.push_back (k);
        series.y.push_back (k == 700'000 ? 100.0 : 0.0);
    }
    const auto image = draw ({ .panels = { forceOverTime ({ series }) } });

    // The flat line is a few pixels thick, so only the peak colours the upper half.
    CHECK (pixelsOf (image.getClippedImage ({ 0, 0, image.getWidth(), image.getHeight() / 2 }), colourFor ("force")) > 300);
}

TEST_CASE ("plot: empty series, constants, gaps and extremes are drawn without errors", "[host][io][plot]")
{
    const auto inf = std::numeric_limits<double>::infinity();
    const auto nan = std::nan ("");

    for (const auto& y : { std::vector<double> {},
                           { 0.0 },
                           { 3.0, 3.0, 3.0 },
                           { nan, nan },
                           { 1.0, nan, 2.0, inf, -inf, 3.0 },
                           { 1e308, -1e308 },
                           { 1e299, -1e299 },
                           { 5e-324, 1e-320 },
                           { 1.0, 1.0 + 1e-15 },
                           { 1e9, 1e9 + 1.0 } })
    {
        Series series { .label = "series", .y = y };
        for (std::size_t k = 0; k < y.size(); ++k)
            series.x.push_back (static_cast<double> (k));
        auto dots = series;
        dots.style = Series::Style::points;
        draw ({ .panels = { forceOverTime ({ series, dots }), forceOverTime ({}) }, .width = 400 });
    }
}

TEST_CASE ("plot: any text can be drawn", "[host][io][plot]")
{
    const std::vector<std::string> texts {
        std::string (5000, 'm'),
        std::string (300, ' '),
        "two\nlines\tand\1 more",
        "\xff\xfe bytes",
        "力 σ → ½",
    };
    for (const auto& text : texts)
    {
        auto axes = forceOverTime (std::vector<Series> (30, sine (text, 1.0)));
        axes.title = axes.x.name = axes.y.name = axes.y.unit = text;
        draw ({ .title = text, .panels = { axes, axes }, .width = 500 });
    }
}

TEST_CASE ("plot: any values can be drawn", "[host][io][plot]")
{
    const auto drawn = [] (const std::vector<std::pair<std::uint64_t, std::uint64_t>>& bits) {
        const TemporaryFolder folder;
        Series series { .label = "any" };
        for (const auto& [x, y] : bits)
        {
            series.x.push_back (std::bit_cast<double> (x));
            series.y.push_back (std::bit_cast<double> (y));
        }
        RC_ASSERT (writeFigure ({ .panels = { forceOverTime ({ series }) }, .width = 200 }, folder / "plot.png").has_value());
    };
    tactus::test::property ("any bit pattern", drawn);
}

TEST_CASE ("plot: invalid figures are refused, each error with its id", "[host][io][plot]")
{
    const TemporaryFolder folder;
    const auto axes = forceOverTime ({ sine ("x", 1.0) });
    auto ragged = axes;
    ragged.series[0].y.pop_back();

    CHECK (errorOf ({}, folder / "plot.png") == "plot/no_panels");
    CHECK (errorOf ({ .panels = { ragged } }, folder / "plot.png") == "plot/ragged_series");
    CHECK (errorOf ({ .panels = { axes }, .width = 10 }, folder / "plot.png") == "plot/size");
    CHECK (errorOf ({ .panels = { axes }, .width = 100'000 }, folder / "plot.png") == "plot/size");
    CHECK (errorOf ({ .panels = std::vector (20, axes), .width = 800, .height = 400 }, folder / "plot.png") == "plot/size");
    CHECK (errorOf ({ .panels = std::vector (200, axes) }, folder / "plot.png") == "plot/size");
    CHECK (errorOf ({ .panels = { axes } }, folder / "missing/plot.png") == "output/unwritable");
    CHECK (folder.isEmpty());
}

TEST_CASE ("plot: a PNG states its size on paper, and text has the same size on paper at any resolution", "[host][io][plot]")
{
    const TemporaryFolder folder;
    const auto axes = forceOverTime ({ sine ("x", 1.0) });
    const auto pixelsPerMetre = [&] (double dpi) {
        Figure figure { .panels = { axes }, .width = static_cast<int> (4.0 * dpi), .dpi = dpi };
        REQUIRE (writeFigure (figure, folder / "plot.png").has_value());
        const auto bytes = folder.textOf ("plot.png");
        const auto at = bytes.find ("pHYs");
        REQUIRE (at != std::string::npos);
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value << 8 | static_cast<unsigned char> (bytes[at + 4 + i]);
        return value;
    };
    CHECK (pixelsPerMetre (96.0) == 3780);
    CHECK (pixelsPerMetre (300.0) == 11811);
    draw ({ .panels = { axes }, .width = 1200, .dpi = 300.0 });   // the picture can be read
}

TEST_CASE ("plot: the name of the file decides whether it is a PNG, an SVG or a PDF", "[host][io][plot]")
{
    const TemporaryFolder folder;
    const Figure figure { .title = "a title", .panels = { forceOverTime ({ sine ("x", 1.0) }) } };
    for (const auto& [name, start] : { std::pair { "a.png", "\x89PNG" }, { "a.svg", "<?xml" }, { "a.pdf", "%PDF-" } })
    {
        REQUIRE (writeFigure (figure, folder / name).has_value());
        CHECK (folder.textOf (name).starts_with (start));
    }
    CHECK (errorOf (figure, folder / "a.gif") == "plot/kind");
}

TEST_CASE ("plot: a map shows the colour of each value at its place, and the scale next to it", "[host][io][plot]")
{
    Axes panel { .x = { "time", "s" }, .y = { "frequency", "Hz" } };
    panel.map = HeatMap { .x = { 0.0, 2.0 },
                          .y = { 0.0, 10.0 },
                          .columns = 2,
                          .rows = 2,
                          .values = { 0.0, 1.0, 0.25, std::nan ("") },
                          .colour = { "amplitude", "dB re 1 N" },
                          .range = { 0.0, 1.0 } };
    const auto image = draw ({ .panels = { panel } });
    const auto dark = pixelsOf (image, colourOfLevel (0.0)), bright = pixelsOf (image, colourOfLevel (1.0)), third = pixelsOf (image, colourOfLevel (0.25));
    CHECK (dark > 100'000);
    CHECK (bright == Approx (dark).epsilon (0.05));   // the colour bar also contains some of each
    CHECK (third == Approx (dark).epsilon (0.05));
    const auto find = [&] (Colour colour) {
        double x = 0.0, y = 0.0;
        int count = 0;
        for (int j = 0; j < image.getHeight(); ++j)
            for (int i = 0; i < image.getWidth(); ++i)
                if (image.getPixelAt (i, j) == juce::Colour (colour.red, colour.green, colour.blue)) ++count, x += i, y += j;
        return std::pair (x / count, y / count);
    };
    const auto low_left = find (colourOfLevel (0.0)), high_left = find (colourOfLevel (1.0)), low_right = find (colourOfLevel (0.25));
    CHECK (high_left.second < low_left.second - 100.0);
    CHECK (low_right.first > low_left.first + 100.0);
    CHECK (low_right.second == Approx (low_left.second).margin (20.0));

    const TemporaryFolder folder;
    panel.map->values.pop_back();
    CHECK (errorOf ({ .panels = { panel } }, folder / "plot.png") == "plot/ragged_map");
}

TEST_CASE ("plot: the colours of a scale get lighter evenly", "[host][io][plot]")
{
    const auto lightness = [] (double part) {
        const auto c = colourOfLevel (part);
        return juce::Colour (c.red, c.green, c.blue).getPerceivedBrightness();
    };
    for (int i = 1; i <= 20; ++i)
        CHECK (lightness (i / 20.0) > lightness ((i - 1) / 20.0));
    CHECK (colourOfLevel (-3.0) == colourOfLevel (0.0));
    CHECK (colourOfLevel (7.0) == colourOfLevel (1.0));
    CHECK (colourOfLevel (std::nan ("")) == colourOfLevel (0.0));
}
