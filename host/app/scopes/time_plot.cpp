// SPDX-License-Identifier: GPL-3.0-or-later
#include "time_plot.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

namespace
{
constexpr double hysteresis = 0.02;   // as a fraction of the range
constexpr float grip = 8.0f;

using Edge = ScopeTrigger::Edge;

juce::String textOf (Edge e)
{
    if (e == Edge::off) return TRANS ("trigger off");
    return e == Edge::rising ? TRANS ("trigger rising") : TRANS ("trigger falling");
}

Edge nextOf (Edge e)
{
    if (e == Edge::off) return Edge::rising;
    return e == Edge::rising ? Edge::falling : Edge::off;
}
}   // namespace

void TimePlot::show (const Signals& signals)
{
    TraceList all;
    std::vector<std::string> units;
    std::map<std::string, std::size_t> ports_of_unit;
    lines.clear();
    for (const auto& port : spec.ports)
    {
        const auto traces = signals (port);
        if (traces.empty()) continue;
        const auto nth = ports_of_unit[traces.front()->unit()]++;
        for (std::size_t i = 0; i < traces.size(); ++i)
        {
            const auto& t = traces[i];
            const auto component = traces.size() == 3 ? juce::String (t->name()).fromLastOccurrenceOf (".", false, false) : juce::String();
            lines.push_back ({ laneFor (units, t->unit()), traceColour (theme(), t->quantity(), nth, i, traces.size()), fromUtf8 (port), component });
            all.push_back (t);
        }
    }
    layOut (units);
    repaint();
    if (all.empty()) return;

    rate_hz = all.front()->rate();
    const double noise = lanes.front().y.isEmpty() ? 0.0 : hysteresis * lanes.front().y.size();
    seen = windowOf (all, spec.seconds, spec.trigger, noise);
    if (! spec.is_frozen) spec.back_s = 0.0;
    seen.from -= spec.back_s * rate_hz;
    seen.to -= spec.back_s * rate_hz;
    zero = seen.trigger ? static_cast<double> (*seen.trigger) : static_cast<double> (endOf (all));

    std::vector<Extent> extents (units.size());
    columns.resize (all.size());
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        const auto lane = lines[i].lane;
        columns[i].update (all[i], seen.from, seen.to, static_cast<std::size_t> (std::max (1.0f, lanes[lane].area.getWidth())));
        extents[lane].include (columns[i].extent());
    }
    for (std::size_t i = 0; i < lanes.size(); ++i)
    {
        lanes[i].x = { (seen.from - zero) / rate_hz, (seen.to - zero) / rate_hz };
        lanes[i].x_unit = "s";
        lanes[i].y = rangeOf (units[i], extents[i]);
    }
    followCurves (lines.size());
}

std::vector<ScopePlot::Action> TimePlot::actions()
{
    const auto next = [this] (juce::Component&) {
        auto& edge = spec.trigger.edge;
        if (edge == Edge::off && ! lanes.empty()) spec.trigger.level = 0.5 * (lanes.front().y.low + lanes.front().y.high);
        edge = nextOf (edge);
        if (context.onChange) context.onChange();
    };
    return { lengthAction ({ 5e-3, 10e-3, 20e-3, 50e-3, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0 }, TRANS ("Length of the window; the wheel changes it too")),
             { textOf (spec.trigger.edge), TRANS ("Trigger on an edge of the first trace; drag the marker to set the level"), next } };
}

void TimePlot::mouseDown (const juce::MouseEvent& e)
{
    ScopePlot::mouseDown (e);
    back_before = spec.back_s;
    drags_level = hasTrigger() && ! lanes.empty()
                  && std::abs (e.position.y - levelPixel()) < grip && e.position.x > lanes.front().area.getRight() - 4.0f * grip;
}

void TimePlot::mouseDrag (const juce::MouseEvent& e)
{
    ScopePlot::mouseDrag (e);
    if (lanes.empty()) return;
    const auto& lane = lanes.front();
    if (drags_level)
        spec.trigger.level = lane.yAt (std::clamp (e.position.y, lane.area.getY(), lane.area.getBottom()));
    else if (spec.is_frozen)
    {
        const double dragged_s = static_cast<double> (e.getOffsetFromDragStart().x) / std::max (1.0, static_cast<double> (lane.area.getWidth())) * spec.seconds;
        spec.back_s = std::clamp (back_before + dragged_s, 0.0, std::max (0.0, Trace::seconds - spec.seconds));
    }
    repaint();
}

void TimePlot::paintLane (juce::Graphics& g, const Lane& lane, std::size_t index)
{
    for (std::size_t i = 0; i < std::min (lines.size(), columns.size()); ++i)
        if (lines[i].lane == index) drawTrace (g, lane, columns[i].columns(), zero, rate_hz, lines[i].colour);

    if (const auto legend = legendOf (index); ! legend.empty()) paintLegend (g, lane.area.withHeight (16.0f).withTrimmedLeft (2.0f), legend, false);
}

std::optional<Cursor> TimePlot::onCurve (const Cursor& c) const
{
    std::optional<Cursor> nearest;
    for (std::size_t i = 0; i < std::min (lines.size(), columns.size()); ++i)
    {
        const auto& shown = columns[i].columns();
        const double at = (zero + c.x * rate_hz - shown.first) / shown.ticks_each;
        const bool is_there = at >= 0.0 && at < static_cast<double> (shown.all.size());
        if (lines[i].lane != c.lane || i != c.curve.value_or (i) || ! is_there) continue;
        const auto& extent = shown.all[static_cast<std::size_t> (at)].extent;
        if (extent.isEmpty()) continue;
        const double value = std::clamp (c.y, extent.low, extent.high);
        if (! nearest || std::abs (value - c.y) < std::abs (nearest->y - c.y)) nearest = Cursor { c.lane, c.x, value, i };
    }
    return nearest;
}

/// The ports of a lane, if there are several, and the components of its first vector: components differ in lightness, in the same way for all vectors.
auto TimePlot::legendOf (std::size_t lane) const -> std::vector<Entry>
{
    std::vector<Entry> ports, components;
    juce::StringArray seen_ports;
    for (const auto& l : lines)
    {
        if (l.lane != lane) continue;
        if (seen_ports.addIfNotAlreadyThere (l.port)) ports.push_back ({ l.colour, l.port });
        if (l.component.isNotEmpty() && components.size() < 3) components.push_back ({ l.colour, l.component });
    }
    if (ports.size() < 2) return components;
    ports.insert (ports.end(), components.begin(), components.end());
    return ports;
}

void TimePlot::paintOver (juce::Graphics& g)
{
    if (! hasTrigger()) return;
    const auto& lane = lanes.front();
    const float y = levelPixel();
    if (y >= lane.area.getY() && y <= lane.area.getBottom())
    {
        g.setColour (theme().accent.withAlpha (0.7f));
        const float dashes[] = { 4.0f, 4.0f };
        g.drawDashedLine ({ lane.area.getX(), y, lane.area.getRight(), y }, dashes, 2, 1.0f);
        juce::Path marker;
        marker.addTriangle (lane.area.getRight() + 6.0f, y - 6.0f, lane.area.getRight() + 6.0f, y + 6.0f, lane.area.getRight() - 4.0f, y);
        g.setColour (theme().accent);
        g.fillPath (marker);
    }
    if (seen.trigger) return;
    g.setFont (lookOf (*this).font (11.0f));
    g.setColour (theme().warning);
    g.drawText (TRANS ("waiting for trigger"), lane.area.reduced (8.0f, 4.0f).removeFromBottom (14.0f), juce::Justification::bottomLeft, false);
}

juce::String TimePlot::emptyText() const
{
    return spec.ports.empty() ? TRANS ("Select a wire and press P, or click + above, to plot its signal over time") : whyEmpty();
}

}   // namespace tactus::host
