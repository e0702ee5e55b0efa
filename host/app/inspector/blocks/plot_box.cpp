// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_box.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/tools/figures/axis.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double reach_n = 5.0, shallowest_m = 1e-4, deepest_m = 0.02;   // how hard a hand presses, and the range of how deep it gets
constexpr int points = 96;

std::string symbolOf (const UnitRule& r) { return r.kind == UnitRule::Kind::fixed ? std::string (r.unit.symbol) : std::string(); }

/// The unit in the brackets of a label: "mm" of "depth (mm)".
juce::String unitIn (const AxisScale& scale)
{
    const auto text = fromUtf8 (scale.label);
    return text.contains ("(") ? text.fromLastOccurrenceOf ("(", false, false).upToLastOccurrenceOf (")", false, false) : juce::String();
}
}   // namespace

namespace
{
/// The axes of a plot and the area inside them.
struct Axes
{
    AxisScale along, up;
    Extent xs, ys;   // in the units of the labels
    juce::Rectangle<float> inner;

    float toX (double v) const { return inner.getX() + inner.getWidth() * static_cast<float> ((v - xs.low) / xs.size()); }
    float toY (double v) const { return inner.getBottom() - inner.getHeight() * static_cast<float> ((v - ys.low) / ys.size()); }
};

std::optional<std::pair<Extent, Extent>> extentOf (const PlotData& plot)
{
    Extent x, y;
    for (std::size_t i = 0; i < plot.x.size(); ++i)
        if (std::isfinite (plot.x[i]) && std::isfinite (plot.y[i]))
        {
            x.include (plot.x[i]);
            y.include (plot.y[i]);
        }
    if (x.isEmpty()) return std::nullopt;
    x.include (0.0);
    y.include (0.0);
    y = widened (y, 0.0);
    x = widened (x, 0.0);
    y.high += 0.08 * y.size();   // keeps the highest point clear of the unit
    if (plot.kind == PlotData::Kind::stems) x.high += 0.08 * x.size();
    return std::pair { x, y };
}

Axes paintAxes (juce::Graphics& g, juce::Rectangle<float> area, const PlotData& plot, const Extent& x, const Extent& y, const Theme& theme)
{
    Axes axes { axisScale (x, "", plot.x_unit), axisScale (y, "", plot.y_unit), {}, {}, area.reduced (8.0f, 6.0f) };
    axes.xs = axes.along.shown (x);
    axes.ys = axes.up.shown (y);
    const auto x_ticks = ticksWithin (axes.xs, 4), y_ticks = ticksWithin (axes.ys, 4);
    float left = 0.0f;
    for (const auto& t : y_ticks)
        left = std::max (left, g.getCurrentFont().getStringWidthFloat (fromUtf8 (t.text)));
    auto& inner = axes.inner;
    const auto top = inner.removeFromTop (16.0f), bottom = inner.removeFromBottom (16.0f);
    inner.removeFromLeft (left + 6.0f);
    inner.removeFromRight (6.0f);

    for (const auto& t : y_ticks)
    {
        const float at = axes.toY (t.at);
        g.setColour (theme.hairline);
        g.drawHorizontalLine (juce::roundToInt (at), inner.getX(), inner.getRight());
        g.setColour (theme.dim);
        g.drawText (fromUtf8 (t.text), juce::Rectangle<float> (area.getX() + 8.0f, at - 7.0f, left, 14.0f), juce::Justification::centredRight, false);
    }
    g.drawText (unitIn (axes.up), top, juce::Justification::centredLeft, false);
    const auto x_unit = unitIn (axes.along);
    const float unit_width = g.getCurrentFont().getStringWidthFloat (x_unit);
    for (const auto& t : x_ticks)
    {
        const float at = axes.toX (t.at);
        g.setColour (theme.hairline);
        g.drawVerticalLine (juce::roundToInt (at), inner.getY(), inner.getBottom());
        g.setColour (theme.dim);
        const juce::Rectangle<float> place (at - 24.0f, bottom.getY() + 2.0f, 48.0f, 14.0f);
        if (at + 14.0f < bottom.getRight() - unit_width) g.drawText (fromUtf8 (t.text), place, juce::Justification::centred, false);
    }
    g.drawText (x_unit, bottom.withTrimmedTop (2.0f), juce::Justification::centredRight, false);
    return axes;
}
}   // namespace

void paintPlot (juce::Graphics& g, juce::Rectangle<float> area, const PlotData& plot, const Look& look)
{
    const auto& theme = look.theme();
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (area, 4.0f);
    const auto extent = extentOf (plot);
    if (! extent) return;
    g.setFont (look.font (11.0f));
    const auto axes = paintAxes (g, area, plot, extent->first, extent->second, theme);

    g.setColour (plot.quantity == Quantity::any ? theme.accent : theme.of (plot.quantity));
    juce::Path line;
    bool begun = false;   // JUCE treats a path with only a start point as empty
    for (std::size_t i = 0; i < plot.x.size(); ++i)
    {
        const juce::Point<float> p { axes.toX (axes.along.shown (plot.x[i])), axes.toY (axes.up.shown (plot.y[i])) };
        if (! std::isfinite (p.x) || ! std::isfinite (p.y)) continue;
        if (plot.kind == PlotData::Kind::stems)
        {
            g.fillRect (juce::Rectangle<float> (p.x - 1.0f, p.y, 2.0f, std::max (0.0f, axes.toY (0.0) - p.y)));
            g.fillEllipse (juce::Rectangle<float> (6.0f, 6.0f).withCentre (p));
            continue;
        }
        std::exchange (begun, true) ? line.lineTo (p) : line.startNewSubPath (p);
        if (i < plot.knots.size() && plot.knots[i]) g.fillEllipse (juce::Rectangle<float> (6.0f, 6.0f).withCentre (p));
    }
    g.strokePath (line, juce::PathStrokeType (1.8f));
}

namespace
{
PlotData emptyPlot (const UnitRule& x, const UnitRule& y)
{
    PlotData f;
    f.x_unit = symbolOf (x);
    f.y_unit = symbolOf (y);
    f.quantity = y.kind == UnitRule::Kind::fixed ? y.unit.quantity : Quantity::any;
    return f;
}
}   // namespace

PlotData plotOf (const Law& law, const UnitRule& x, const UnitRule& y)
{
    auto f = emptyPlot (x, y);
    if (! law || law.kind == Law::Kind::dissipation) return f;
    double end = law.inverse (reach_n);
    if (law.kind == Law::Kind::table)
        end = law.table.empty() ? shallowest_m : 1.2 * law.table.x.back();
    else if (x.kind == UnitRule::Kind::fixed && x.unit.quantity == Quantity::length)
        end = std::clamp (std::isfinite (end) ? end : deepest_m, shallowest_m, deepest_m);
    if (! std::isfinite (end) || ! (end > 0.0)) end = 1.0;
    for (int i = 0; i <= points; ++i)
        f.x.push_back (end * i / points);
    if (law.kind == Law::Kind::table)
        for (const double at : law.table.x)
            if (at >= 0.0) f.x.push_back (at);
    std::ranges::sort (f.x);
    for (const double at : f.x)
    {
        f.y.push_back (law (at));
        f.knots.push_back (law.kind == Law::Kind::table && std::ranges::count (law.table.x, at) > 0);
    }
    return f;
}

PlotData plotOf (const Curve& curve, const UnitRule& x, const UnitRule& y)
{
    auto f = emptyPlot (x, y);
    f.x = curve.x;
    f.y = curve.y;
    f.knots.assign (f.x.size(), true);
    return f;
}

}   // namespace tactus::host
