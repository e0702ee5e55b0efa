// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot.hpp"

#include <host/tools/figures/figure/figure_layout.hpp>
#include <host/tools/figures/figure/png_density.hpp>
#include <host/tools/figures/figure/polyline.hpp>
#include <host/tools/figures/figure/vector_canvas.hpp>
#include <tactus/file/atomic_file.hpp>

#include <juce_events/juce_events.h>
#include <juce_graphics/juce_graphics.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace tactus::host
{

namespace
{
namespace ink
{
const juce::Colour text { 0xff1b1f25 };
const juce::Colour faint_text { 0xff5a6470 };
const juce::Colour axis { 0xff3a424c };
const juce::Colour zero { 0xffaab3bd };
const juce::Colour grid { 0xffe4e8ec };
}   // namespace ink

juce::Colour inkOf (Colour colour)
{
    const auto legible = onPaper (colour);
    return { legible.red, legible.green, legible.blue };
}

class Painter
{
public:
    explicit Painter (const FigureLayout& arranged) : layout (arranged), style (arranged.style) {}

    void paint (juce::Graphics& graphics)
    {
        graphics.setColour (juce::Colours::white);
        graphics.fillRect (0, 0, layout.width, juce::roundToInt (layout.height));

        graphics.setColour (ink::text);
        float y = style.px (21);
        for (const auto& line : layout.title)
        {
            style.title.draw (graphics, line, { layout.panels[0].plot.getX(), y }, Align::left);
            y += style.titleRow();
        }

        for (const auto& panel : layout.panels)
        {
            drawTitle (graphics, panel);
            drawLegend (graphics, panel);
            panel.bar_scale.label.empty() ? drawGrid (graphics, panel) : drawMap (graphics, panel);
            drawAxes (graphics, panel);
            drawSeries (graphics, panel);
        }
    }

private:
    static PixelMap mapX (const Panel& panel)
    {
        return { panel.x_range.low, panel.x_range.high, panel.plot.getX(), panel.plot.getRight() };
    }

    static PixelMap mapY (const Panel& panel)
    {
        return { panel.y_range.low, panel.y_range.high, panel.plot.getBottom(), panel.plot.getY() };
    }

    /// Fills a rectangle that is aligned to pixels, so that hairlines are sharp.
    static void fill (juce::Graphics& graphics, float x, float y, float width, float height)
    {
        graphics.fillRect (juce::Rectangle<float> (std::floor (x), std::floor (y), width, height).toNearestInt());
    }

    float firstRow (const Panel& panel) const
    {
        return panel.plot.getY() - panel.header + style.px (2) + 0.5f * style.headerRow();
    }

    void drawTitle (juce::Graphics& graphics, const Panel& panel) const
    {
        graphics.setColour (ink::text);
        for (const auto& line : style.panel_title.wrapped (textOf (panel.axes->title), panel.plot.getWidth(), 1))
            style.panel_title.draw (graphics, line, { panel.plot.getX(), firstRow (panel) }, Align::left);
    }

    void drawLegend (juce::Graphics& graphics, const Panel& panel) const
    {
        const bool below_title = ! panel.axes->title.empty() && ! panel.title_in_legend_row;
        float y = firstRow (panel) + (below_title ? style.headerRow() : 0.0f);

        for (const auto& row : panel.legend)
        {
            float x = panel.plot.getX();
            if (panel.title_in_legend_row)
            {
                x = panel.plot.getRight() + style.px (18);   // the last entry's width includes a gap, which is added back here
                for (const auto& entry : row)
                    x -= entry.width;
            }

            for (const auto& entry : row)
            {
                graphics.setColour (inkOf (entry.colour));
                if (entry.style == Series::Style::line)
                    graphics.fillRect (juce::Rectangle<float> (x, y - 0.5f * style.stroke(), style.swatch(), style.stroke()));
                else
                    drawDot (graphics, { x + 0.5f * style.swatch(), y });

                graphics.setColour (ink::text);
                style.small.draw (graphics, entry.label, { x + style.swatch() + style.px (6), y }, Align::left);
                x += entry.width;
            }
            y += style.headerRow();
        }

        if (panel.not_in_legend > 0)
        {
            const auto more = "and " + juce::String (panel.not_in_legend) + " more";
            graphics.setColour (ink::faint_text);
            style.small.draw (graphics, more, { panel.plot.getRight(), y - style.headerRow() }, Align::right);
        }
    }

    void drawGrid (juce::Graphics& graphics, const Panel& panel) const
    {
        const auto& plot = panel.plot;

        // There is no grid line right next to an axis, because the axis would look twice as thick.
        if (panel.has_x)
            for (const auto& tick : panel.x_ticks)
                if (const float x = mapX (panel) (tick.at); x > plot.getX() + 1.0f)
                {
                    graphics.setColour (tick.at == 0.0 ? ink::zero : ink::grid);
                    fill (graphics, x, plot.getY(), style.hairline(), plot.getHeight());
                }
        if (panel.has_data)
            for (const auto& tick : panel.y_ticks)
                if (const float y = mapY (panel) (tick.at); y < plot.getBottom() - 1.0f)
                {
                    graphics.setColour (tick.at == 0.0 ? ink::zero : ink::grid);
                    fill (graphics, plot.getX(), y, plot.getWidth(), style.hairline());
                }
    }

    /// The map, with one pixel of an image for each pixel of the plot. A pixel shows the highest of the values that it covers.
    void drawMap (juce::Graphics& graphics, const Panel& panel) const
    {
        const auto& map = *panel.axes->map;
        const auto width = juce::roundToInt (panel.plot.getWidth()), height = juce::roundToInt (panel.plot.getHeight());
        const auto share = [] (int i, int pixels, std::size_t cells) {
            const auto all = static_cast<std::size_t> (pixels), first = static_cast<std::size_t> (i) * cells / all;
            return std::pair (first, std::max (first + 1, static_cast<std::size_t> (i + 1) * cells / all));
        };
        juce::Image image (juce::Image::RGB, width, height, true, juce::SoftwareImageType());
        for (int x = 0; x < width; ++x)
            for (int y = 0; y < height; ++y)
            {
                const auto [c0, c1] = share (x, width, map.columns);
                const auto [r0, r1] = share (height - 1 - y, height, map.rows);
                double highest = std::numeric_limits<double>::quiet_NaN();
                for (auto c = c0; c < c1; ++c)
                    for (auto r = r0; r < r1; ++r)
                        highest = std::fmax (highest, map.values[c * map.rows + r]);
                const auto c = colourOfLevel ((highest - map.range.low) / map.range.size());
                image.setPixelAt (x, y, std::isnan (highest) ? juce::Colours::white : juce::Colour (c.red, c.green, c.blue));
            }
        graphics.drawImage (image, panel.plot, juce::RectanglePlacement::stretchToFit);
        drawBar (graphics, panel);
    }

    void drawBar (juce::Graphics& graphics, const Panel& panel) const
    {
        const auto& bar = panel.bar;
        constexpr int steps = 64;
        const float step = bar.getHeight() / static_cast<float> (steps);
        for (int i = 0; i < steps; ++i)
        {
            const auto c = colourOfLevel ((i + 0.5) / steps);
            graphics.setColour (juce::Colour (c.red, c.green, c.blue));
            graphics.fillRect (bar.withTop (bar.getBottom() - static_cast<float> (i + 1) * step).withHeight (i == 0 ? step : step + 1.0f));
        }
        const PixelMap to_y { panel.bar_range.low, panel.bar_range.high, bar.getBottom(), bar.getY() };
        for (const auto& tick : panel.bar_ticks)
        {
            const float y = to_y (tick.at);
            graphics.setColour (ink::axis);
            fill (graphics, bar.getRight(), y, style.tickLength(), style.hairline());
            style.small.draw (graphics, textOf (tick.text), { bar.getRight() + style.tickGap(), y }, Align::left);
        }
        graphics.setColour (ink::text);
        const auto lines = style.label.wrapped (textOf (panel.bar_scale.label), bar.getHeight(), 1);
        const float x = static_cast<float> (layout.width) - style.px (8) - 0.5f * style.label.height();
        if (! lines.empty()) style.label.drawUpwards (graphics, lines.front(), { x, bar.getCentreY() });
    }

    void drawAxes (juce::Graphics& graphics, const Panel& panel) const
    {
        const auto& plot = panel.plot;
        const float line = style.hairline();
        graphics.setColour (ink::axis);
        fill (graphics, plot.getX() - line, plot.getY(), line, plot.getHeight() + line);
        fill (graphics, plot.getX() - line, plot.getBottom(), plot.getWidth() + line, line);

        if (panel.has_x)
            drawXTicks (graphics, panel);
        if (panel.has_data)
            drawYTicks (graphics, panel);
        else
        {
            graphics.setColour (ink::faint_text);
            style.label.draw (graphics, "no data", plot.getCentre(), Align::centre);
        }

        graphics.setColour (ink::text);
        float x = plot.getX() - style.tickGap() - layout.tick_numbers - style.px (8) + 0.5f * style.label.height();
        x -= static_cast<float> (panel.y_label.size()) * style.label.height();
        for (const auto& text : panel.y_label)
        {
            style.label.drawUpwards (graphics, text, { x, plot.getCentreY() });
            x += style.label.height();
        }

        if (! panel.shows_x)
            return;
        const float y = plot.getBottom() + style.tickGap() + style.small.height() + style.px (4) + 0.5f * style.label.height();
        for (const auto& text : style.label.wrapped (textOf (panel.x_scale.label), plot.getWidth(), 1))
            style.label.draw (graphics, text, { plot.getCentreX(), y }, Align::centre);
    }

    void drawXTicks (juce::Graphics& graphics, const Panel& panel) const
    {
        const float numbers = panel.plot.getBottom() + style.tickGap() + 0.5f * style.small.height();

        for (const auto& tick : panel.x_ticks)
        {
            const float x = mapX (panel) (tick.at);
            graphics.setColour (ink::axis);
            fill (graphics, x, panel.plot.getBottom(), style.hairline(), style.tickLength());
            if (panel.shows_x)
                style.small.draw (graphics, textOf (tick.text), { x, numbers }, Align::centre);
        }
    }

    void drawYTicks (juce::Graphics& graphics, const Panel& panel) const
    {
        for (const auto& tick : panel.y_ticks)
        {
            const float y = mapY (panel) (tick.at);
            graphics.setColour (ink::axis);
            fill (graphics, panel.plot.getX() - style.tickLength(), y, style.tickLength(), style.hairline());
            style.small.draw (graphics, textOf (tick.text), { panel.plot.getX() - style.tickGap(), y }, Align::right);
        }
    }

    void drawSeries (juce::Graphics& graphics, const Panel& panel) const
    {
        const juce::Graphics::ScopedSaveState restore (graphics);
        graphics.reduceClipRegion (panel.plot.expanded (style.dot()).toNearestInt());

        // Converts data to pixels in one step, without a copy in the displayed units.
        const auto fromData = [] (PixelMap map, const AxisScale& axis) {
            map.low = map.low * axis.unit + axis.origin;
            map.high = map.high * axis.unit + axis.origin;
            return map;
        };
        const auto to_x = fromData (mapX (panel), panel.x_scale);
        const auto to_y = fromData (mapY (panel), panel.y_scale);

        for (std::size_t i = 0; i < panel.axes->series.size(); ++i)
        {
            const auto& series = panel.axes->series[i];
            graphics.setColour (inkOf (series.colour.value_or (colourFor (panel.axes->y.name, i))));

            if (series.style == Series::Style::points)
                for (const auto& [x, y] : dotsAt (series.x, series.y, to_x, to_y))
                    drawDot (graphics, { x, y });
            else
                for (const auto& line : linesThrough (series.x, series.y, to_x, to_y))
                    drawLine (graphics, line);
        }
    }

    void drawDot (juce::Graphics& graphics, juce::Point<float> at) const
    {
        graphics.fillEllipse (juce::Rectangle<float> (style.dot(), style.dot()).withCentre (at));
    }

    static juce::Path pathThrough (std::span<const PixelPoint> line)
    {
        juce::Path path;
        path.startNewSubPath (line[0].x, line[0].y);
        for (const auto& [x, y] : line.subspan (1))
            path.lineTo (x, y);
        return path;
    }

    void drawLine (juce::Graphics& graphics, std::span<const PixelPoint> line) const
    {
        if (line.size() == 1)
        {
            drawDot (graphics, { line[0].x, line[0].y });   // a single point between gaps: a line through it would be invisible
            return;
        }
        if (auto* canvas = dynamic_cast<VectorCanvas*> (&graphics.getInternalContext()))
            return canvas->stroke (pathThrough (line), style.stroke());

        // Drawn in pieces, because the time to fill a path grows faster than its length.
        constexpr std::size_t piece = 256;
        for (std::size_t begin = 0; begin + 1 < line.size(); begin += piece)
        {
            const auto path = pathThrough (line.subspan (begin, std::min (piece + 1, line.size() - begin)));
            graphics.strokePath (path, { style.stroke(), juce::PathStrokeType::curved, juce::PathStrokeType::rounded });
        }
    }

    const FigureLayout& layout;
    const FigureStyle& style;
};

Result<> check (const Figure& figure, const std::filesystem::path& path)
{
    constexpr int smallest = 200, largest = 16'384;

    if (! isFigureFile (path))
        return Message::error ("plot/kind", path.string(), "a figure cannot be written as this kind of file", std::string ("end its name in ") + figure_kinds);

    if (figure.panels.empty())
        return Message::error ("plot/no_panels", path.string(), "the figure has no panels", "record something to plot");

    if (figure.width < smallest || figure.width > largest || figure.height < 0 || figure.height > largest)
        return Message::error ("plot/size", path.string(),
                               "a figure cannot be " + std::to_string (figure.width) + " by " + std::to_string (figure.height) + " pixels",
                               "choose a width from " + std::to_string (smallest) + " to " + std::to_string (largest)
                                   + " pixels, and a height of at most " + std::to_string (largest));

    for (const auto& axes : figure.panels)
    {
        if (axes.map && axes.map->values.size() != axes.map->columns * axes.map->rows)
            return Message::error ("plot/ragged_map", path.string(), "the map does not have columns times rows values",
                                   "give one value for each column and row");
        for (const auto& [label, x, y, colour, style] : axes.series)
            if (x.size() != y.size())
                return Message::error ("plot/ragged_series", path.string(),
                                       "series '" + label + "' has " + std::to_string (x.size()) + " x values and " + std::to_string (y.size()) + " y values",
                                       "give one y value per x value");
    }
    return {};
}

/// The figure as a file of this kind.
std::string contentOf (const FigureLayout& layout, const std::string& title, const std::filesystem::path& kind)
{
    const double dpi = 96.0 * double { layout.style.scale };
    if (kind != ".png")
    {
        VectorCanvas canvas (static_cast<float> (layout.width), std::round (layout.height));
        juce::Graphics graphics (canvas);
        Painter (layout).paint (graphics);
        return kind == ".svg" ? canvas.svg (title, dpi) : canvas.pdf (title, dpi);
    }
    juce::Image image (juce::Image::RGB, layout.width, juce::roundToInt (layout.height), true, juce::SoftwareImageType());
    {
        juce::Graphics graphics (image);
        Painter (layout).paint (graphics);
    }
    juce::MemoryOutputStream png;
    juce::PNGImageFormat().writeImageToStream (image, png);
    return withDensity ({ static_cast<const char*> (png.getData()), png.getDataSize() }, dpi);
}
}   // namespace

bool isFigureFile (const std::filesystem::path& path)
{
    const auto kind = path.extension();
    return kind == ".png" || kind == ".svg" || kind == ".pdf";
}

Result<> writeFigure (const Figure& figure, const std::filesystem::path& path)
{
    if (const auto checked = check (figure, path); ! checked)
        return checked;

    // JUCE's fonts exist only while JUCE is initialised; if the program has already initialised it, this does nothing.
    const juce::ScopedJuceInitialiser_GUI juce_is_up;

    FigureLayout layout (figure);
    if (! layout.arrange())
        return Message::error ("plot/size", path.string(), "the figure is too small for " + std::to_string (figure.panels.size()) + " panels",
                               "plot fewer panels, make the figure taller, or leave out its height");

    const auto bytes = contentOf (layout, figure.title, path.extension());
    auto file = AtomicFile::create (path);
    if (! file)
        return file.error();
    if (! file->stream().write (bytes.data(), static_cast<std::streamsize> (bytes.size())))
        return file->writeError();
    return file->commit();
}

}   // namespace tactus::host
