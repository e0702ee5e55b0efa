// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "lettering.hpp"
#include <host/tools/figures/axis.hpp>
#include <host/tools/figures/plot.hpp>

#include <juce_graphics/juce_graphics.h>

#include <vector>

namespace tactus::host
{

/// The sizes of a figure's parts in pixels. The values are for 96 pixels per inch.
struct FigureStyle
{
    explicit FigureStyle (float scale);

    float px (float at_96_dpi) const noexcept { return at_96_dpi * scale; }
    float hairline() const noexcept;
    float stroke() const noexcept { return px (1.4f); }
    float dot() const noexcept { return px (4.4f); }
    float swatch() const noexcept { return px (20); }
    float barWidth() const noexcept { return px (14); }
    float barGap() const noexcept { return px (12); }
    float tickLength() const noexcept { return px (4); }
    float tickGap() const noexcept { return px (8); }   // the gap between an axis and its numbers
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
    float width = 0.0f;   // in pixels, including the gap to the next entry
};

struct Panel
{
    const Axes* axes = nullptr;
    bool has_data = false;
    bool is_function = true;   // true if x never decreases, like time; then the range of x needs no margin
    Extent x_values, y_values;
    AxisScale x_scale, y_scale;
    Extent x_range, y_range;   // in the units that the axes show
    std::vector<Tick> x_ticks, y_ticks;
    double least_y_step = 0.0;   // between ticks
    bool has_x = false;          // true if the panel has ticks along x, perhaps shared with its neighbours
    bool shows_x = true;         // true if the panel shows numbers at the ticks along x
    std::vector<juce::String> y_label;
    std::vector<std::vector<LegendEntry>> legend;   // rows
    std::size_t not_in_legend = 0;
    bool title_in_legend_row = false;
    float header = 0.0f, footer = 0.0f;
    AxisScale bar_scale;   // of a map's colours; its label is empty if there is no map
    Extent bar_range;
    std::vector<Tick> bar_ticks;
    juce::Rectangle<float> plot, bar;
};

/// The layout of a figure. Plots are aligned left and right. Legends are above the plots, where they cover no data.
class FigureLayout
{
public:
    explicit FigureLayout (const Figure& figure);

    /// Returns false if the panels do not fit.
    bool arrange();

    FigureStyle style;
    std::vector<juce::String> title;
    std::vector<Panel> panels;
    int width = 0;
    float height = 0.0f;
    float tick_numbers = 0.0f;   // width of the widest number along y

private:
    void arrangeX();
    void arrangeY();
    void arrangeHeader (Panel& panel) const;
    void arrangeLegend (Panel& panel) const;
    void arrangeBars();
    float naturalPlotHeight() const noexcept;
    float widestOf (const std::vector<Tick>& ticks) const;

    const Figure& figure;
    float left = 0.0f, right = 0.0f;   // edges of the plots
    float bar_room = 0.0f;             // to the right of the plots, for colour bars
};

}   // namespace tactus::host
