// SPDX-License-Identifier: GPL-3.0-or-later
#include "figure_layout.hpp"

#include <host/tools/figures/typeface.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus::host
{

namespace
{
Panel measured (const Axes& axes)
{
    Panel panel;
    panel.axes = &axes;

    for (const auto& series : axes.series)
    {
        double before = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < series.x.size(); ++i)
        {
            if (! isPlottable (series.x[i]) || ! isPlottable (series.y[i]))
                continue;
            panel.x_values.include (series.x[i]);
            panel.y_values.include (series.y[i]);
            panel.is_function = panel.is_function && series.x[i] >= before;
            before = series.x[i];
        }
    }

    panel.x_values.include (axes.x_shown);
    panel.y_values.include (axes.y_shown);
    const bool has_map = axes.map && ! axes.map->values.empty();
    if (has_map)
    {
        panel.x_values.include (axes.map->x);
        panel.y_values.include (axes.map->y);
        panel.bar_scale = axisScale (axes.map->range, axes.map->colour.name, axes.map->colour.unit);
        if (axes.map->colour.unit.starts_with ("dB")) panel.bar_scale = { .label = axes.map->colour.name + " (" + axes.map->colour.unit + ")" };
        panel.bar_range = panel.bar_scale.shown (axes.map->range);
    }
    panel.has_data = ! panel.x_values.isEmpty();
    panel.y_scale = axisScale (panel.y_values, axes.y.name, axes.y.unit);
    if (has_map && axes.y.unit == "Hz" && panel.y_values.high < 1e4) panel.y_scale = { .label = axes.y.name + " (Hz)" };   // 1000 Hz, not 1 kHz
    panel.y_range = panel.y_scale.shown (panel.y_values);
    if (! has_map) panel.y_range = widened (panel.y_range, 0.05);
    panel.least_y_step = axes.y.whole && panel.y_scale.origin == 0.0 ? 1.0 : 0.0;
    return panel;
}

bool shareX (const Panel& a, const Panel& b)
{
    return a.axes->x.name == b.axes->x.name && a.axes->x.unit == b.axes->x.unit;
}

/// Gives neighbouring panels with the same quantity along x the same range.
void alignX (std::vector<Panel>& panels)
{
    for (auto first = panels.begin(); first != panels.end();)
    {
        auto end = first;
        Extent values;
        bool are_functions = true, has_map = false;
        for (; end != panels.end() && shareX (*first, *end); ++end)
        {
            values.include (end->x_values);
            are_functions = are_functions && end->is_function;
            has_map = has_map || ! end->bar_scale.label.empty();
        }

        const auto scale = axisScale (values, first->axes->x.name, first->axes->x.unit);
        auto range = are_functions ? roundedOutwards (widened (scale.shown (values), 0.0), 10) : widened (scale.shown (values), 0.04);
        if (has_map) range = scale.shown (values);   // a map fills its panel
        for (; first != end; ++first)
        {
            first->x_scale = scale;
            first->x_range = range;
            first->has_x = ! values.isEmpty();
            first->shows_x = first + 1 == end;
        }
    }
}

float scaleOf (const Figure& figure)
{
    return figure.dpi > 0.0 ? static_cast<float> (figure.dpi / 96.0) : static_cast<float> (figure.width) / 800.0f;
}
}   // namespace

FigureStyle::FigureStyle (float s)
    : scale (s),
      small (regularTypeface(), 14.0f * scale),
      label (regularTypeface(), 15.0f * scale),
      panel_title (boldTypeface(), 15.0f * scale),
      title (boldTypeface(), 18.0f * scale)
{
}

float FigureStyle::hairline() const noexcept
{
    return std::max (1.0f, std::round (px (0.75f)));
}

FigureLayout::FigureLayout (const Figure& figure_to_arrange)
    : style (scaleOf (figure_to_arrange)), width (figure_to_arrange.width), figure (figure_to_arrange)
{
    for (const auto& axes : figure.panels)
        panels.push_back (measured (axes));
    alignX (panels);
}

bool FigureLayout::arrange()
{
    constexpr float lowest_plot = 40, highest_figure = 8192;   // in pixels, at 96 dpi
    const auto n = static_cast<float> (panels.size());

    // Heights depend on widths (legends wrap) and widths on heights (ticks differ): two passes are enough.
    left = style.px (70);
    for (int pass = 0; pass < 2; ++pass)
    {
        arrangeBars();
        right = static_cast<float> (width) - style.px (18) - bar_room;
        arrangeX();
        title = style.title.wrapped (textOf (figure.title), right - left, 2);
        for (auto& panel : panels)
            arrangeHeader (panel);

        const float top = title.empty() ? style.px (8) : style.px (14) + static_cast<float> (title.size()) * style.titleRow();
        float used = top + style.px (6);
        for (const auto& panel : panels)
            used += panel.header + panel.footer;
        height = figure.height > 0 ? static_cast<float> (figure.height) : used + n * naturalPlotHeight();

        const float plot_height = std::floor ((height - used) / n);
        if (plot_height < style.px (lowest_plot) || height > style.px (highest_figure))
            return false;

        float y = top;
        for (auto& panel : panels)
        {
            panel.plot = { left, std::round (y + panel.header), right - left, plot_height };
            y += panel.header + plot_height + panel.footer;
        }
        arrangeY();
    }

    for (auto& panel : panels)
    {
        panel.plot.setLeft (left);
        if (bar_room > 0.0f) panel.bar = panel.plot.withX (panel.plot.getRight() + style.barGap()).withWidth (style.barWidth());
    }
    return true;
}

float FigureLayout::naturalPlotHeight() const noexcept
{
    if (panels.size() == 1)
        return style.px (400);
    return style.px (panels.size() < 4 ? 200 : 150);
}

/// The ticks of the colour bars, and the room for these bars.
void FigureLayout::arrangeBars()
{
    bar_room = 0.0f;
    for (auto& panel : panels)
    {
        if (panel.bar_scale.label.empty()) continue;
        panel.bar_ticks = ticksWithin (panel.bar_range, std::max (3, static_cast<int> (panel.plot.getHeight() / style.px (40))));
        bar_room = std::max (bar_room, style.barGap() + style.barWidth() + style.tickGap() + widestOf (panel.bar_ticks) + style.px (4) + style.label.height());
    }
}

void FigureLayout::arrangeX()
{
    const float plot_width = right - left;
    float overhang = 0.0f;   // how far the last number extends beyond the end of its axis

    for (auto& panel : panels)
    {
        // Uses as many ticks as possible with space between their numbers.
        auto at_most = std::max (2, static_cast<int> (plot_width / style.px (60)));
        panel.x_ticks = ticksWithin (panel.x_range, at_most);
        while (at_most > 2 && static_cast<float> (at_most) * (widestOf (panel.x_ticks) + style.px (18)) > plot_width)
            panel.x_ticks = ticksWithin (panel.x_range, --at_most);

        panel.footer = panel.shows_x ? style.tickGap() + style.small.height() + style.px (4) + style.label.height() + style.px (10)
                                     : style.px (14);

        if (panel.shows_x && panel.has_x && ! panel.x_ticks.empty())
        {
            const auto& last = panel.x_ticks.back();
            const auto free = static_cast<float> ((panel.x_range.high - last.at) / panel.x_range.size()) * plot_width;
            overhang = std::max (overhang, 0.5f * style.small.width (textOf (last.text)) - free);
        }
    }
    right = std::min (right, static_cast<float> (width) - bar_room - overhang - style.px (8));
}

void FigureLayout::arrangeY()
{
    constexpr std::size_t most_label_lines = 3;

    float labels = 0.0f;
    tick_numbers = 0.0f;
    for (auto& panel : panels)
    {
        // There are at least two ticks, because a single one would not show the scale.
        auto at_most = std::max (2, static_cast<int> (panel.plot.getHeight() / style.px (34)));
        panel.y_ticks = ticksWithin (panel.y_range, at_most, panel.least_y_step);
        while (panel.y_ticks.size() < 2 && at_most < 10)
            panel.y_ticks = ticksWithin (panel.y_range, ++at_most, panel.least_y_step);

        panel.y_label = style.label.wrapped (textOf (panel.y_scale.label), panel.plot.getHeight() + 0.5f * panel.header, most_label_lines);
        labels = std::max (labels, static_cast<float> (panel.y_label.size()) * style.label.height());
        if (panel.has_data)
            tick_numbers = std::max (tick_numbers, widestOf (panel.y_ticks));
    }
    left = std::round (style.px (8) + labels + style.px (8) + tick_numbers + style.tickGap());
}

void FigureLayout::arrangeHeader (Panel& panel) const
{
    arrangeLegend (panel);

    const bool has_title = ! panel.axes->title.empty();
    const auto& first_row = panel.legend.front();

    float needed = style.panel_title.width (textOf (panel.axes->title)) + style.px (24);
    for (const auto& entry : first_row)
        needed += entry.width;
    panel.title_in_legend_row = has_title && ! first_row.empty() && panel.legend.size() == 1 && needed <= right - left;

    std::size_t rows = first_row.empty() ? 0 : panel.legend.size();
    if (has_title && ! panel.title_in_legend_row)
        ++rows;
    panel.header = style.px (8) + static_cast<float> (rows) * style.headerRow();
}

void FigureLayout::arrangeLegend (Panel& panel) const
{
    constexpr std::size_t most_rows = 4;
    const float plot_width = right - left;
    const float beside_label = style.swatch() + style.px (6 + 18);

    panel.legend.assign (1, {});
    panel.not_in_legend = 0;
    float used = 0.0f;

    for (std::size_t i = 0; i < panel.axes->series.size(); ++i)
    {
        const auto& series = panel.axes->series[i];
        const auto lines = style.small.wrapped (textOf (series.label), plot_width - beside_label, 1);
        if (lines.empty())
            continue;

        const LegendEntry entry { .label = lines[0],
                                  .colour = series.colour.value_or (colourFor (panel.axes->y.name, i)),
                                  .style = series.style,
                                  .width = beside_label + style.small.width (lines[0]) };

        const bool fits = used == 0.0f || used + entry.width <= plot_width;
        if (panel.not_in_legend > 0 || (! fits && panel.legend.size() == most_rows))
        {
            ++panel.not_in_legend;
            continue;
        }
        if (! fits)
        {
            panel.legend.emplace_back();
            used = 0.0f;
        }
        panel.legend.back().push_back (entry);
        used += entry.width;
    }
}

float FigureLayout::widestOf (const std::vector<Tick>& ticks) const
{
    float widest = 0.0f;
    for (const auto& tick : ticks)
        widest = std::max (widest, style.small.width (textOf (tick.text)));
    return widest;
}

}   // namespace tactus::host
