// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/io/axis.hpp>
#include <host/io/lettering.hpp>
#include <host/io/plot.hpp>

#include <juce_graphics/juce_graphics.h>

#include <vector>

namespace tactus::host
{

/// The sizes of a figure's parts in pixels. All grow with its width; they are given for one 800 wide.
struct FigureStyle
{
    explicit FigureStyle (int width);

    float px (float at_800) const noexcept { return at_800 * scale; }
    float hairline() const noexcept;
    float stroke() const noexcept { return px (1.4f); }
    float dot() const noexcept { return px (4.4f); }
    float swatch() const noexcept { return px (20); }
    float tickLength() const noexcept { return px (4); }
    float tickGap() const noexcept { return px (8); }   // from an axis to the numbers at it
    float headerRow() const noexcept { return px (20); }
    float titleRow() const noexcept { return px (22); }

    float scale;
    Lettering small, label, panel_title, title;
};

struct LegendEntry
{
    juce::String label;
    Colour colour;
    Series::Style style = Series::Style::line;
    float width = 0.0f;   // with the gap to the next
};

struct Panel
{
    const Axes* axes = nullptr;
    bool has_data = false;
    bool is_function = true;   // x never goes back, as time does; then the range of x needs no air
    Extent x_values, y_values;
    AxisScale x_scale, y_scale;
    Extent x_range, y_range;   // as shown
    std::vector<Tick> x_ticks, y_ticks;
    bool has_x = false;    // ticks along x, perhaps from the neighbours it shares them with
    bool shows_x = true;   // their numbers
    std::vector<juce::String> y_label;
    std::vector<std::vector<LegendEntry>> legend;   // rows
    std::size_t not_in_legend = 0;
    bool title_in_legend_row = false;
    float header = 0.0f, footer = 0.0f;
    juce::Rectangle<float> plot;
};

/// Where everything in a figure goes. Plots are aligned left and right; legends stand above them, where they cover no data.
class FigureLayout
{
public:
    explicit FigureLayout (const Figure& figure);

    /// False if there is no room for the panels.
    bool arrange();

    FigureStyle style;
    std::vector<juce::String> title;
    std::vector<Panel> panels;
    int width = 0;
    float height = 0.0f;
    float tick_numbers = 0.0f;   // width of the widest along y

private:
    void arrangeX();
    void arrangeY();
    void arrangeHeader (Panel& panel) const;
    void arrangeLegend (Panel& panel) const;
    float naturalPlotHeight() const noexcept;
    float widestOf (const std::vector<Tick>& ticks) const;

    const Figure& figure;
    float left = 0.0f, right = 0.0f;   // of the plots
};

}   // namespace tactus::host
