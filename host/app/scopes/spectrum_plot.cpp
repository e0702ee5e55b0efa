// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrum_plot.hpp"

#include <host/app/model/with_prefix.hpp>

#include <cmath>

namespace tactus::host
{

namespace
{
constexpr double silence = 1e-12, quietest_top = 1e-6;
}

double SpectrumPlot::height (double amplitude) const { return spec.in_decibels ? 20.0 * std::log10 (std::max (amplitude, silence)) : amplitude; }

void SpectrumPlot::show (const Signals& signals)
{
    if (spec.ports.empty()) lanes.clear();
    if (refreshes++ % every != 0 && ! lanes.empty()) return;
    repaint();
    lines.clear();
    units.clear();
    highest.reset();
    missing = 0;
    double rate = 1.0;
    std::map<std::string, std::size_t> ports_of_unit;
    for (const auto& port : spec.ports)
    {
        const auto traces = signals (port);
        if (traces.empty()) continue;
        const auto nth = ports_of_unit[traces.front()->unit()]++;
        for (std::size_t i = 0; i < traces.size(); ++i)
        {
            const auto& t = *traces[i];
            auto lane = std::ranges::find (units, t.unit());
            if (lane == units.end()) lane = units.insert (units.end(), t.unit());
            const auto latest = latestSamples (t, std::min (spec.seconds, most_s));
            missing = std::max (missing, latest.missing);
            lines.push_back ({ static_cast<std::size_t> (lane - units.begin()), traceColour (theme(), t.quantity(), nth, i), spectrumOf (latest.values, t.rate()), {} });
            rate = t.rate();
            if (lane != units.begin()) continue;
            if (const auto p = peakOf (lines.back().spectrum, std::max (lowest_hz, 2.0 * lines.back().spectrum.resolution_hz)); p && (! highest || p->amplitude > highest->amplitude)) highest = p;
        }
    }
    layOut (units);
    for (std::size_t i = 0; i < lanes.size(); ++i)
    {
        double top = spec.in_decibels ? quietest_top : 0.0;
        for (const auto& l : lines)
            if (l.lane == i)
                for (const double a : l.spectrum.amplitude)
                    top = std::max (top, a);
        const auto key = (spec.in_decibels ? "dB " : "") + units[i];
        const auto seen = spec.in_decibels ? Extent { height (std::max (top, silence) * std::pow (10.0, -decades_down)), height (top) } : Extent { 0.0, top };
        lanes[i].y = rangeOf (key, seen);
        if (! spec.in_decibels && spec.by_hand.count (key) == 0) lanes[i].y.low = 0.0;
        lanes[i].unit = key;
        lanes[i].x = { lowest_hz, std::max (10.0, 0.5 * rate) };
        lanes[i].x_unit = "Hz";
        lanes[i].is_logarithmic = true;
    }
    for (auto& l : lines)
        l.path = pathOf (l.spectrum, lanes[l.lane]);
}

std::vector<ScopePlot::Action> SpectrumPlot::actions()
{
    const auto lengths = [this] (juce::Component& below)
    {
        juce::PopupMenu menu;
        for (const double s : { 0.1, 0.2, 0.5, 1.0, 2.0, 4.0 })
            menu.addItem (juce::String (withPrefix (s, "s", 1)), true, std::abs (spec.seconds - s) < 1e-6 * s, [safe = juce::Component::SafePointer (this), s]
                          {
                if (safe == nullptr) return;
                safe->spec.seconds = s;
                if (safe->desk.onChange) safe->desk.onChange(); });
        menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (below));
    };
    const auto toggle = [this] (juce::Component&)
    {
        spec.in_decibels = ! spec.in_decibels;
        refreshes = 0;
        if (desk.onChange) desk.onChange();
    };
    return { { juce::String (withPrefix (spec.seconds, "s", 1)), "How much of the past is looked at: longer tells closer frequencies apart", lengths },
             { spec.in_decibels ? "dB" : "linear", "Decibels of one unit, or amplitudes", toggle } };
}

juce::Path SpectrumPlot::pathOf (const Spectrum& spectrum, const Lane& lane) const
{
    juce::Path path;
    float column = 0.0f, top = 0.0f;
    bool is_begun = false;
    const auto first = static_cast<std::size_t> (std::ceil (0.5 * lowest_hz / spectrum.step_hz));
    for (std::size_t i = std::max<std::size_t> (1, first); i < spectrum.amplitude.size(); ++i)
    {
        // Of the lines that share a pixel the highest.
        const auto p = lane.toPixels (spectrum.hz (i), height (spectrum.amplitude[i]));
        if (is_begun && p.x - column < 1.0f)
        {
            top = std::min (top, p.y);
            continue;
        }
        is_begun ? path.lineTo (column, top) : path.startNewSubPath (p);
        is_begun = true;
        column = p.x;
        top = p.y;
    }
    if (is_begun) path.lineTo (column, top);
    return path;
}

void SpectrumPlot::paintLane (juce::Graphics& g, const Lane&, std::size_t index)
{
    for (const auto& l : lines)
    {
        if (l.lane != index) continue;
        g.setColour (l.colour);
        g.strokePath (l.path, juce::PathStrokeType (1.5f));
    }
}

void SpectrumPlot::paintOver (juce::Graphics& g)
{
    if (spec.cursors.empty() && highest)
        paintReadout (g, { "peak " + juce::String::fromUTF8 (withPrefix (highest->hz, "Hz").c_str()), juce::String::fromUTF8 (withPrefix (highest->amplitude, units.front()).c_str()) }, lanes.front().area.withTop (lanes.front().area.getBottom() - 48.0f).withWidth (std::min (132.0f, lanes.front().area.getWidth())));
    if (missing == 0) return;
    g.setFont (lookOf (*this).font (11.0f));
    g.setColour (theme().warning);
    g.drawText (juce::String (missing) + " ticks are missing", lanes.front().area.reduced (8.0f, 4.0f).removeFromTop (14.0f), juce::Justification::topLeft, false);
}

juce::String SpectrumPlot::emptyWords() const { return spec.ports.empty() ? "Select a wire and press P, or click + above: what frequencies are in it is drawn here" : "Nothing has run yet"; }

}   // namespace tactus::host
