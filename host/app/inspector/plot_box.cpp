// SPDX-License-Identifier: GPL-3.0-or-later
#include "plot_box.hpp"

#include <host/io/axis.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double reach_n = 5.0, shallowest_m = 1e-4, deepest_m = 0.02;   // what a hand presses with, and how deep it gets
constexpr int points = 96;

std::string symbolOf (const UnitRule& r) { return r.kind == UnitRule::Kind::fixed ? std::string (r.unit.symbol) : std::string(); }

/// "m" of "depth (mm)": what stands in the brackets of a label.
juce::String unitIn (const AxisScale& scale)
{
    const auto text = juce::String::fromUTF8 (scale.label.c_str());
    return text.contains ("(") ? text.fromLastOccurrenceOf ("(", false, false).upToLastOccurrenceOf (")", false, false) : juce::String();
}
}   // namespace

void paintFigure (juce::Graphics& g, juce::Rectangle<float> area, const Figure& figure, const Look& look)
{
    const auto& theme = look.theme();
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (area, 4.0f);
    if (figure.x.empty()) return;
    Extent x, y;
    for (std::size_t i = 0; i < figure.x.size(); ++i)
        if (std::isfinite (figure.x[i]) && std::isfinite (figure.y[i]))
        {
            x.include (figure.x[i]);
            y.include (figure.y[i]);
        }
    if (x.isEmpty()) return;
    x.include (0.0);
    y.include (0.0);
    y = widened (y, 0.0);
    x = widened (x, 0.0);
    y.high += 0.08 * y.size();   // so that the highest stands clear of the unit
    if (figure.kind == Figure::Kind::stems) x.high += 0.08 * x.size();
    const auto along = axisScale (x, "", figure.x_unit), up = axisScale (y, "", figure.y_unit);
    const auto xs = along.shown (x), ys = up.shown (y);
    const auto x_ticks = ticksWithin (xs, 4), y_ticks = ticksWithin (ys, 4);

    g.setFont (look.font (11.0f));
    float left = 0.0f;
    for (const auto& t : y_ticks)
        left = std::max (left, g.getCurrentFont().getStringWidthFloat (juce::String::fromUTF8 (t.text.c_str())));
    auto inner = area.reduced (8.0f, 6.0f);
    const auto top = inner.removeFromTop (16.0f), bottom = inner.removeFromBottom (16.0f);
    inner.removeFromLeft (left + 6.0f);
    inner.removeFromRight (6.0f);
    const auto toX = [&] (double v)
    { return inner.getX() + inner.getWidth() * static_cast<float> ((v - xs.low) / xs.size()); };
    const auto toY = [&] (double v)
    { return inner.getBottom() - inner.getHeight() * static_cast<float> ((v - ys.low) / ys.size()); };

    for (const auto& t : y_ticks)
    {
        g.setColour (theme.hairline);
        g.drawHorizontalLine (juce::roundToInt (toY (t.at)), inner.getX(), inner.getRight());
        g.setColour (theme.dim);
        g.drawText (juce::String::fromUTF8 (t.text.c_str()), juce::Rectangle<float> (area.getX() + 8.0f, toY (t.at) - 7.0f, left, 14.0f), juce::Justification::centredRight, false);
    }
    g.drawText (unitIn (up), top, juce::Justification::centredLeft, false);
    const auto x_unit = unitIn (along);
    const float unit_width = g.getCurrentFont().getStringWidthFloat (x_unit);
    for (const auto& t : x_ticks)
    {
        g.setColour (theme.hairline);
        g.drawVerticalLine (juce::roundToInt (toX (t.at)), inner.getY(), inner.getBottom());
        g.setColour (theme.dim);
        const auto place = juce::Rectangle<float> (toX (t.at) - 24.0f, bottom.getY() + 2.0f, 48.0f, 14.0f);
        if (place.getCentreX() + 14.0f < bottom.getRight() - unit_width) g.drawText (juce::String::fromUTF8 (t.text.c_str()), place, juce::Justification::centred, false);
    }
    g.drawText (x_unit, bottom.withTrimmedTop (2.0f), juce::Justification::centredRight, false);

    const auto colour = figure.quantity == Quantity::any ? theme.accent : theme.of (figure.quantity);
    g.setColour (colour);
    juce::Path line;
    bool begun = false;   // a path that only starts counts as empty
    for (std::size_t i = 0; i < figure.x.size(); ++i)
    {
        const juce::Point<float> p { toX (along.shown (figure.x[i])), toY (up.shown (figure.y[i])) };
        if (! std::isfinite (p.x) || ! std::isfinite (p.y)) continue;
        if (figure.kind == Figure::Kind::stems)
        {
            g.fillRect (juce::Rectangle<float> (p.x - 1.0f, p.y, 2.0f, std::max (0.0f, toY (0.0) - p.y)));
            g.fillEllipse (juce::Rectangle<float> (6.0f, 6.0f).withCentre (p));
            continue;
        }
        std::exchange (begun, true) ? line.lineTo (p) : line.startNewSubPath (p);
        if (i < figure.knots.size() && figure.knots[i]) g.fillEllipse (juce::Rectangle<float> (6.0f, 6.0f).withCentre (p));
    }
    g.strokePath (line, juce::PathStrokeType (1.8f));
}

Figure figureOf (const Law& law, const UnitRule& x, const UnitRule& y)
{
    Figure f;
    f.x_unit = symbolOf (x);
    f.y_unit = symbolOf (y);
    f.quantity = y.kind == UnitRule::Kind::fixed ? y.unit.quantity : Quantity::any;
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

Figure figureOf (const Curve& curve, const UnitRule& x, const UnitRule& y)
{
    Figure f;
    f.x_unit = symbolOf (x);
    f.y_unit = symbolOf (y);
    f.quantity = y.kind == UnitRule::Kind::fixed ? y.unit.quantity : Quantity::any;
    f.x = curve.x;
    f.y = curve.y;
    f.knots.assign (f.x.size(), true);
    return f;
}

}   // namespace tactus::host
