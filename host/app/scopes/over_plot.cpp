// SPDX-License-Identifier: GPL-3.0-or-later
#include "over_plot.hpp"

#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr double clearly_more = 1.5;
constexpr float thickness = 1.5f, column_width = 0.5f;

const std::shared_ptr<const Trace>& pick (const TraceList& l, int component) { return l[std::min (l.size() - 1, static_cast<std::size_t> (component))]; }

/// The key of the x range. Keeps it apart from the y range, which may have the same unit.
std::string xKey (const std::string& unit) { return "x " + unit; }
}   // namespace

void OverPlot::show (const Signals& signals)
{
    repaint();
    for (auto& age : tail)
        for (auto& piece : age)
            piece = {};
    head.reset();
    lanes.clear();
    const auto tracesOf = [&] (const std::string& port) { return port.empty() ? TraceList {} : signals (port); };
    const auto xs = tracesOf (spec.x), ys = tracesOf (spec.y), states = tracesOf (spec.state);
    if (xs.empty() || ys.empty()) return;

    const auto end = std::min (endOf (xs), endOf (ys));
    const auto ticks = static_cast<std::uint64_t> (spec.seconds * xs.front()->rate());
    const auto from = end - std::min (end, ticks);
    constexpr std::size_t columns = 256;   // so that only new ticks are read for the extents
    const auto of = [&] (MovingColumns& moving, const std::shared_ptr<const Trace>& t) {
        moving.update (t, static_cast<double> (from), static_cast<double> (end), columns);
        return moving.extent();
    };
    travels.resize (xs.size());
    if (spec.component >= 0)
        component = spec.component;
    else
    {
        // Shows the component that moves most. Another one replaces it only if that moves clearly more, so that the choice does not change
        // at every reversal.
        const auto travel = [&] (std::size_t i) {
            const auto e = of (travels[i], xs[i]);
            return e.isEmpty() ? 0.0 : e.size();
        };
        for (std::size_t i = 0; i < xs.size(); ++i)
            if (travel (i) > clearly_more * travel (std::min (xs.size() - 1, static_cast<std::size_t> (component)))) component = static_cast<int> (i);
    }
    const auto &x = *pick (xs, component), &y = *pick (ys, component);
    quantity = y.quantity();
    has_state = states.size() == 1;

    layOut ({ y.unit() });
    auto& lane = lanes.front();
    if (has_state) lane.area.removeFromTop (legend_height);
    lane.x_unit = x.unit();
    lane.x = rangeOf (xKey (x.unit()), of (travels[std::min (xs.size() - 1, static_cast<std::size_t> (component))], pick (xs, component)));
    lane.y = rangeOf (y.unit(), of (heights, pick (ys, component)));
    draw (x, y, has_state ? states.front().get() : nullptr, from, end);
}

OverPlot::Part OverPlot::partAt (const Trace* state, std::uint64_t tick)
{
    if (state == nullptr) return Part::plain;
    const double s = tick >= state->begin() && tick < state->end() ? state->at (tick) : 0.0;
    if (s < 0.0) return Part::fault;
    if (s < 0.5) return Part::open;
    return s < 1.5 ? Part::stuck : Part::sliding;
}

void OverPlot::draw (const Trace& x, const Trace& y, const Trace* state, std::uint64_t from, std::uint64_t to)
{
    const auto& lane = lanes.front();
    const auto first = std::max ({ from, x.begin(), y.begin() });
    std::vector<double> heights;
    heights.reserve (static_cast<std::size_t> (to > first ? to - first : 0));
    y.each (first, to, [&] (std::uint64_t, double v) { heights.push_back (v); });

    std::optional<juce::Point<float>> last;
    std::size_t last_age = 0;
    float column = 0.0f;
    std::array<juce::Range<float>, parts> spans;
    std::array<bool, parts> is_spanned {};
    const auto flush = [&] {
        for (std::size_t part = 0; part < parts; ++part)
            if (is_spanned[part])
            {
                const float left = column + 0.5f * (column_width - thickness), top = spans[part].getStart() - 0.5f * thickness;
                tail[last_age][part].spans.addWithoutMerging ({ left, top, thickness, spans[part].getLength() + thickness });
            }
        is_spanned = {};
    };
    x.each (first, to, [&] (std::uint64_t tick, double v) {
        const double height = heights[static_cast<std::size_t> (tick - first)];
        if (! isPlottable (v) || ! isPlottable (height))
        {
            flush();
            last.reset();
            return;
        }
        const auto p = lane.toPixels (v, height);
        const auto part = static_cast<std::size_t> (partAt (state, tick));
        const auto age = std::min<std::uint64_t> (ages - 1, (tick - from) * ages / std::max<std::uint64_t> (1, to - from));
        const auto before = last.value_or (p);
        const float column_now = column_width * std::floor (p.x / column_width);
        if (age != last_age || column_now != column) flush();
        column = column_now;
        last_age = age;
        last = p;
        if (std::abs (p.x - before.x) > 1.0f)
        {
            tail[age][part].lines.startNewSubPath (before);
            tail[age][part].lines.lineTo (p);
            return;
        }
        const auto moved = juce::Range<float>::between (before.y, p.y);
        spans[part] = is_spanned[part] ? spans[part].getUnionWith (moved) : moved;
        is_spanned[part] = true;
    });
    flush();
    head = last;
}

/// A past pass has none of the colours of the legend: a faded one would look like another state.
juce::Colour colourOfPast (const Theme& theme) { return theme.canvas.interpolatedWith (theme.of (Quantity::torque), 0.45f); }

juce::Colour OverPlot::colourOf (Part part) const
{
    switch (part)
    {
    case Part::plain:
        return theme().of (quantity);
    case Part::open:
        return theme().dim;
    case Part::stuck:
        return theme().of (Quantity::length);
    case Part::sliding:
        return theme().of (Quantity::force);
    case Part::fault:
        break;
    }
    return theme().stop;
}

void OverPlot::paintLane (juce::Graphics& g, const Lane&, std::size_t)
{
    // Sticking is drawn over sliding, so that it stays visible when sticking and slipping alternate too fast for the eye.
    for (std::size_t age = 0; age < ages; ++age)
        for (const auto part : { Part::plain, Part::open, Part::sliding, Part::stuck, Part::fault })
        {
            const auto& piece = tail[age][static_cast<std::size_t> (part)];
            const bool is_past = has_state && age + fresh_ages < ages;
            const float fade = static_cast<float> (age + 1) / static_cast<float> (ages);
            const float alpha = 0.2f + 0.8f * fade;
            g.setColour (is_past ? colourOfPast (theme()).withAlpha (alpha) : colourOf (part).withAlpha (has_state ? 1.0f : alpha * alpha));
            g.fillRectList (piece.spans);
            g.strokePath (piece.lines, juce::PathStrokeType (thickness));
        }
    if (head)
    {
        g.setColour (theme().text);
        g.fillEllipse (juce::Rectangle<float> (6.0f, 6.0f).withCentre (*head));
    }
}

void OverPlot::paintOver (juce::Graphics& g)
{
    const auto& area = lanes.front().area;
    if (! has_state) return;
    const auto legend = area.withY (area.getY() - legend_height).withHeight (legend_height);
    paintLegend (g, legend,
                 { { colourOf (Part::stuck), TRANS ("stuck") },
                   { colourOf (Part::sliding), TRANS ("sliding") },
                   { colourOf (Part::open), TRANS ("no contact") },
                   { colourOfPast (theme()), TRANS ("before") } });
}

void OverPlot::zoomX (double factor, const Lane& lane, float at)
{
    const double about = lane.xAt (at);
    const Extent zoomed { about + (lane.x.low - about) * factor, about + (lane.x.high - about) * factor };
    if (isPlottable (zoomed.low) && isPlottable (zoomed.high) && zoomed.size() > 1e-12) spec.zoomed[xKey (lane.x_unit)] = zoomed;
}

std::vector<ScopePlot::Action> OverPlot::actions()
{
    static constexpr const char* names[] = { "x", "y", "z" };
    const auto along = spec.component < 0 ? filled (TRANS ("along %1 (auto)"), names[component % 3]) : filled (TRANS ("along %1"), names[spec.component % 3]);
    const auto next = [this] (juce::Component&) {
        spec.component = spec.component >= 2 ? -1 : spec.component + 1;
        spec.zoomed.clear();
        if (context.onChange) context.onChange();
    };
    return { lengthAction ({ 0.2, 0.5, 1.0, 2.0, 5.0, 10.0 }, TRANS ("Length of the tail")),
             { along, TRANS ("Component of vectors; auto shows the one that moves most"), next } };
}

juce::String OverPlot::emptyText() const
{
    return spec.x.empty() || spec.y.empty() ? TRANS ("Choose the x and y axes above, such as position and force") : whyEmpty();
}

}   // namespace tactus::host
