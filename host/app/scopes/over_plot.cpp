// SPDX-License-Identifier: GPL-3.0-or-later
#include "over_plot.hpp"

#include <host/app/model/with_prefix.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr double clearly_more = 1.5;
constexpr float thickness = 1.5f, column_width = 0.5f;

const std::shared_ptr<const Trace>& pick (const TraceList& l, int component) { return l[std::min (l.size() - 1, static_cast<std::size_t> (component))]; }

/// Position, force and state share a unit of x at most by chance; the ranges are kept apart by this.
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
    const auto xs = spec.x.empty() ? TraceList {} : signals (spec.x), ys = spec.y.empty() ? TraceList {} : signals (spec.y), states = spec.state.empty() ? TraceList {} : signals (spec.state);
    if (xs.empty() || ys.empty()) return;

    const auto end = std::min (endOf (xs), endOf (ys));
    const auto ticks = static_cast<std::uint64_t> (spec.seconds * xs.front()->rate());
    const auto from = end - std::min (end, ticks);
    if (spec.component >= 0)
        component = spec.component;
    else
    {
        // The way that moves most; another must be clearly longer, so that it does not change in a turn.
        const auto way = [&] (std::size_t i)
        {
            const auto e = extentOf (*xs[i], static_cast<double> (from), static_cast<double> (end));
            return e.isEmpty() ? 0.0 : e.size();
        };
        for (std::size_t i = 0; i < xs.size(); ++i)
            if (way (i) > clearly_more * way (std::min (xs.size() - 1, static_cast<std::size_t> (component)))) component = static_cast<int> (i);
    }
    const auto &x = *pick (xs, component), &y = *pick (ys, component);
    quantity = y.quantity();
    tells_state = states.size() == 1;

    layOut ({ y.unit() });
    auto& lane = lanes.front();
    if (tells_state) lane.area.removeFromTop (legend_height);
    lane.x_unit = x.unit();
    lane.x = rangeOf (xKey (x.unit()), extentOf (x, static_cast<double> (from), static_cast<double> (end)));
    lane.y = rangeOf (y.unit(), extentOf (y, static_cast<double> (from), static_cast<double> (end)));
    draw (x, y, tells_state ? states.front().get() : nullptr, from, end);
}

OverPlot::Part OverPlot::partAt (const Trace* state, std::uint64_t tick)
{
    if (state == nullptr) return Part::plain;
    const double s = tick >= state->begin() && tick < state->end() ? state->at (tick) : 0.0;
    return s < 0.0 ? Part::fault : s < 0.5 ? Part::open
                               : s < 1.5   ? Part::stuck
                                           : Part::sliding;
}

void OverPlot::draw (const Trace& x, const Trace& y, const Trace* state, std::uint64_t from, std::uint64_t to)
{
    const auto& lane = lanes.front();
    const auto first = std::max ({ from, x.begin(), y.begin() });
    std::vector<double> heights;
    heights.reserve (static_cast<std::size_t> (to > first ? to - first : 0));
    y.each (first, to, [&] (std::uint64_t, double v)
            { heights.push_back (v); });

    std::optional<juce::Point<float>> last;
    std::size_t last_age = 0;
    float column = 0.0f;
    std::array<juce::Range<float>, parts> spans;
    std::array<bool, parts> is_spanned {};
    const auto flush = [&]
    {
        for (std::size_t part = 0; part < parts; ++part)
            if (is_spanned[part]) tail[last_age][part].spans.addWithoutMerging ({ column + 0.5f * (column_width - thickness), spans[part].getStart() - 0.5f * thickness, thickness, spans[part].getLength() + thickness });
        is_spanned = {};
    };
    x.each (first, to, [&] (std::uint64_t tick, double v)
            {
        const double height = heights[static_cast<std::size_t> (tick - first)];
        if (! isPlottable (v) || ! isPlottable (height))
        {
            flush();
            last.reset();
            return;
        }
        const auto p = lane.toPixels (v, height);
        const auto part = static_cast<std::size_t> (partAt (state, tick));
        const auto age = std::min (ages - 1, static_cast<std::size_t> (static_cast<double> (tick - from) / static_cast<double> (std::max<std::uint64_t> (1, to - from)) * static_cast<double> (ages)));
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
        is_spanned[part] = true; });
    flush();
    head = last;
}

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
    // Sticking over sliding: where it sticks and slips too fast for the eye, it is seen that it sticks at all.
    for (std::size_t age = 0; age < ages; ++age)
        for (const auto part : { Part::plain, Part::open, Part::sliding, Part::stuck, Part::fault })
        {
            const auto& piece = tail[age][static_cast<std::size_t> (part)];
            const float fade = static_cast<float> (age + 1) / static_cast<float> (ages);
            g.setColour (colourOf (part).withAlpha (0.12f + 0.88f * fade * fade));
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
    if (tells_state) paintLegend (g, area.withY (area.getY() - legend_height).withHeight (legend_height), { { colourOf (Part::stuck), "stuck" }, { colourOf (Part::sliding), "sliding" }, { colourOf (Part::open), "apart" } });
}

void OverPlot::zoomX (double factor, const Lane& lane, float at)
{
    const double about = lane.xAt (at);
    const Extent zoomed { about + (lane.x.low - about) * factor, about + (lane.x.high - about) * factor };
    if (isPlottable (zoomed.low) && isPlottable (zoomed.high) && zoomed.size() > 1e-12) spec.by_hand[xKey (lane.x_unit)] = zoomed;
}

std::vector<ScopePlot::Action> OverPlot::actions()
{
    static constexpr const char* names[] = { "x", "y", "z" };
    const auto along = spec.component < 0 ? "along " + juce::String (names[component % 3]) + " (auto)" : "along " + juce::String (names[spec.component % 3]);
    const auto next = [this] (juce::Component&)
    {
        spec.component = spec.component >= 2 ? -1 : spec.component + 1;
        spec.by_hand.clear();
        if (desk.onChange) desk.onChange();
    };
    const auto lengths = [this] (juce::Component& below)
    {
        juce::PopupMenu menu;
        for (const double s : { 0.2, 0.5, 1.0, 2.0, 5.0, 10.0 })
            menu.addItem (juce::String (withPrefix (s, "s", 1)), true, std::abs (spec.seconds - s) < 1e-6 * s, [safe = juce::Component::SafePointer (this), s]
                          {
                if (safe == nullptr) return;
                safe->spec.seconds = s;
                if (safe->desk.onChange) safe->desk.onChange(); });
        menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (below));
    };
    return { { juce::String (withPrefix (spec.seconds, "s", 1)), "How long the tail is", lengths },
             { along, "Which component of vectors; auto takes the one that moves most", next } };
}

juce::String OverPlot::emptyWords() const { return spec.x.empty() || spec.y.empty() ? "Choose what stands across and what stands up, above: x position, y force" : "Nothing has run yet"; }

}   // namespace tactus::host
