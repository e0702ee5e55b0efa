// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_plot.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/look.hpp>
#include <host/app/text/filled.hpp>
#include <host/tools/figures/axis.hpp>

#include <algorithm>
#include <optional>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int row = 16;   // height of a line of text, in pixels

struct FitAxes
{
    AxisScale along, up;
    Extent xs, ys;   // as shown
    juce::Rectangle<float> inner;

    float toX (double v) const { return inner.getX() + inner.getWidth() * static_cast<float> ((along.shown (v) - xs.low) / xs.size()); }
    float toY (double v) const { return inner.getBottom() - inner.getHeight() * static_cast<float> ((up.shown (v) - ys.low) / ys.size()); }
};

FitAxes fitAxes (const FitPicture& picture)
{
    Extent x, y;
    for (const auto& curve : picture.curves)
        for (std::size_t i = 0; i < curve.x.size(); ++i)
            if (isPlottable (curve.x[i]) && isPlottable (curve.y[i]))
            {
                x.include (curve.x[i]);
                y.include (curve.y[i]);
            }
    if (x.isEmpty())
    {
        x = { 0.0, 1.0 };
        y = { 0.0, 1.0 };
    }
    x = widened (x, 0.02);
    y = widened (y, 0.06);
    FitAxes axes { axisScale (x, picture.x_name, picture.x_unit),
                   axisScale (y, picture.y_name, picture.y_unit),
                   {},
                   {},
                   {} };
    axes.xs = axes.along.shown (x);
    axes.ys = axes.up.shown (y);
    return axes;
}

/// Grid and labels, with room for more lines of the legend below the first. Leaves the area of the curves in axes.inner.
void paintFitAxes (juce::Graphics& g, juce::Rectangle<int> area, FitAxes& axes, const Theme& theme, int more_lines)
{
    const auto top = area.removeFromTop (row + 4);
    area.removeFromTop (row * more_lines);
    const auto bottom = area.removeFromBottom (2 * row + 2);
    const auto y_ticks = ticksWithin (axes.ys, std::max (2, area.getHeight() / 48)), x_ticks = ticksWithin (axes.xs, std::max (2, area.getWidth() / 90));
    float left = 0.0f;
    for (const auto& t : y_ticks)
        left = std::max (left, g.getCurrentFont().getStringWidthFloat (fromUtf8 (t.text)));
    axes.inner = area.toFloat().withTrimmedLeft (left + 8.0f).withTrimmedRight (8.0f);
    const auto& inner = axes.inner;
    const auto xOf = [&] (const Tick& t) { return inner.getX() + inner.getWidth() * static_cast<float> ((t.at - axes.xs.low) / axes.xs.size()); };
    const auto yOf = [&] (const Tick& t) { return inner.getBottom() - inner.getHeight() * static_cast<float> ((t.at - axes.ys.low) / axes.ys.size()); };
    g.setColour (theme.hairline);
    for (const auto& t : y_ticks)
        g.drawHorizontalLine (juce::roundToInt (yOf (t)), inner.getX(), inner.getRight());
    for (const auto& t : x_ticks)
        g.drawVerticalLine (juce::roundToInt (xOf (t)), inner.getY(), inner.getBottom());
    g.setColour (theme.dim);
    for (const auto& t : y_ticks)
        g.drawText (fromUtf8 (t.text), juce::Rectangle<float> (static_cast<float> (area.getX()), yOf (t) - 8.0f, left, 16.0f),
                    juce::Justification::centredRight, false);
    for (const auto& t : x_ticks)
        g.drawText (fromUtf8 (t.text), juce::Rectangle<float> (xOf (t) - 40.0f, static_cast<float> (bottom.getY()) + 2.0f, 80.0f, row),
                    juce::Justification::centred, false);
    g.drawText (fromUtf8 (axes.up.label), top.withTrimmedBottom (4), juce::Justification::centredLeft, false);
    g.drawText (fromUtf8 (axes.along.label), bottom.withTrimmedTop (row + 2), juce::Justification::centred, false);
}

/// A line. Of a long recording, only the lowest and the highest row of each part are drawn, so that a tone keeps its height.
juce::Path fitPath (const FitCurve& curve, const FitAxes& axes)
{
    constexpr std::size_t most_parts = 10000;
    const auto part = std::max<std::size_t> (1, curve.x.size() / most_parts);
    juce::Path path;
    bool begun = false;
    const auto add = [&] (std::size_t i) {
        const juce::Point<float> p { axes.toX (curve.x[i]), axes.toY (curve.y[i]) };
        std::exchange (begun, true) ? path.lineTo (p) : path.startNewSubPath (p);
    };
    for (std::size_t from = 0; from < curve.x.size(); from += part)
    {
        std::optional<std::size_t> low, high;
        for (std::size_t i = from; i < std::min (from + part, curve.x.size()); ++i)
        {
            if (! isPlottable (curve.x[i]) || ! isPlottable (curve.y[i])) continue;
            if (! low || curve.y[i] < curve.y[*low]) low = i;
            if (! high || curve.y[i] > curve.y[*high]) high = i;
        }
        if (! low)
        {
            begun = false;
            continue;
        }
        add (std::min (*low, *high));
        if (*low != *high) add (std::max (*low, *high));
    }
    return path;
}

juce::Colour fitColour (const FitCurve& curve, std::size_t index, const Theme& theme)
{
    if (! curve.is_recorded) return theme.accent;
    return index == 0 ? theme.dim : theme.axes[1];
}

constexpr int sample_width = 16, legend_gap = 16, beside_sample = 6;

int labelWidth (const juce::Graphics& g, const FitCurve& curve)
{
    return juce::roundToInt (g.getCurrentFont().getStringWidthFloat (fromUtf8 (curve.label))) + 1;
}

int legendWidth (const juce::Graphics& g, const FitPicture& picture)
{
    int width = 0;
    for (const auto& curve : picture.curves)
        width += labelWidth (g, curve) + beside_sample + sample_width + legend_gap;
    return width;
}

/// Names and colours in the upper right corner, beside each other or each in a line of its own.
void paintLegend (juce::Graphics& g, juce::Rectangle<int> area, const FitPicture& picture, const Theme& theme, bool one_line)
{
    auto line = area.removeFromTop (row);
    for (std::size_t i = picture.curves.size(); i-- > 0;)
    {
        const auto& curve = picture.curves[i];
        g.setColour (theme.text);
        g.drawText (fromUtf8 (curve.label), line.removeFromRight (labelWidth (g, curve)), juce::Justification::centredLeft, true);
        line.removeFromRight (beside_sample);
        g.setColour (fitColour (curve, i, theme));
        g.fillRect (line.removeFromRight (sample_width).withSizeKeepingCentre (sample_width, 3));
        line.removeFromRight (legend_gap);
        if (! one_line) line = area.removeFromTop (row);
    }
}
}   // namespace

FitPlot::FitPlot()
{
    setInterceptsMouseClicks (false, false);
    setTitle (TRANS ("Recording and fit"));
}

void FitPlot::show (FitPicture p)
{
    picture = std::move (p);
    juce::StringArray names;
    for (const auto& curve : picture.curves)
        names.add (fromUtf8 (curve.label));
    setDescription (names.joinIntoString (", "));
    repaint();
}

void FitPlot::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (getLocalBounds().toFloat(), 4.0f);
    if (picture.curves.empty()) return;
    g.setFont (look.font (12.0f));
    auto axes = fitAxes (picture);
    const auto area = getLocalBounds().reduced (12, 10);
    const float name_width = g.getCurrentFont().getStringWidthFloat (fromUtf8 (axes.up.label));
    const bool one_line = static_cast<int> (name_width) + legendWidth (g, picture) <= area.getWidth();   // the name of the axis is there, too
    paintFitAxes (g, area, axes, theme, one_line ? 0 : static_cast<int> (picture.curves.size()) - 1);
    {
        const juce::Graphics::ScopedSaveState clipped (g);
        g.reduceClipRegion (axes.inner.toNearestInt());
        for (std::size_t i = 0; i < picture.curves.size(); ++i)
        {
            const auto& curve = picture.curves[i];
            g.setColour (fitColour (curve, i, theme).withMultipliedAlpha (curve.is_recorded ? 0.8f : 1.0f));
            g.strokePath (fitPath (curve, axes), juce::PathStrokeType (curve.is_recorded ? 2.6f : 1.4f, juce::PathStrokeType::curved));
        }
    }
    paintLegend (g, getLocalBounds().reduced (16, 10), picture, theme, one_line);
}

}   // namespace tactus::host
