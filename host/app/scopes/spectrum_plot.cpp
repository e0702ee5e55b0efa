// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrum_plot.hpp"

#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
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
    const double rate = readLines (signals);
    layOut (units);
    for (std::size_t i = 0; i < lanes.size(); ++i)
        scale (lanes[i], i, rate);
    for (auto& l : lines)
        l.path = pathOf (l.spectrum, lanes[l.lane]);
    followCurves (lines.size());
}

/// Computes the spectra. Returns the rate in Hz.
double SpectrumPlot::readLines (const Signals& signals)
{
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
            const auto lane = laneFor (units, t.unit());
            const auto latest = latestSamples (t, std::min (spec.seconds, most_s));
            missing = std::max (missing, latest.missing);
            lines.push_back ({ lane, traceColour (theme(), t.quantity(), nth, i, traces.size()), spectrumOf (latest.values, t.rate()), {} });
            rate = t.rate();
            if (lane > 0) continue;
            const auto& spectrum = lines.back().spectrum;
            const auto p = peakOf (spectrum, std::max (lowest_hz, 2.0 * spectrum.resolution_hz));
            if (p && (! highest || p->amplitude > highest->amplitude)) highest = p;
        }
    }
    return rate;
}

void SpectrumPlot::scale (Lane& lane, std::size_t index, double rate)
{
    double top = spec.in_decibels ? quietest_top : 0.0;
    for (const auto& l : lines)
        if (l.lane == index)
            for (const double a : l.spectrum.amplitude)
                top = std::max (top, a);
    Extent seen { 0.0, top };
    if (spec.in_decibels) seen = { height (std::max (top, silence) * std::pow (10.0, -decades_down)), height (top) };
    lane.unit = (spec.in_decibels ? "dB " : "") + units[index];
    lane.y = rangeOf (lane.unit, seen);
    if (! spec.in_decibels && ! spec.zoomed.contains (lane.unit)) lane.y.low = 0.0;
    lane.x = { lowest_hz, std::max (10.0, 0.5 * rate) };
    lane.x_unit = "Hz";
    lane.is_logarithmic = true;
}

std::vector<ScopePlot::Action> SpectrumPlot::actions()
{
    const auto toggle = [this] (juce::Component&) {
        spec.in_decibels = ! spec.in_decibels;
        refreshes = 0;
        if (context.onChange) context.onChange();
    };
    return { lengthAction ({ 0.1, 0.2, 0.5, 1.0, 2.0, 4.0 }, TRANS ("Length of the signal that is analysed; a longer one resolves closer frequencies")),
             { spec.in_decibels ? juce::String ("dB") : TRANS ("linear"), TRANS ("Amplitudes in decibels relative to one unit, or linear"), toggle } };
}

juce::Path SpectrumPlot::pathOf (const Spectrum& spectrum, const Lane& lane) const
{
    juce::Path path;
    float column = 0.0f, top = 0.0f;
    bool is_begun = false;
    const auto first = static_cast<std::size_t> (std::ceil (0.5 * lowest_hz / spectrum.step_hz));
    for (std::size_t i = std::max<std::size_t> (1, first); i < spectrum.amplitude.size(); ++i)
    {
        // Keeps the highest of the lines that share a pixel.
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

std::optional<Cursor> SpectrumPlot::onCurve (const Cursor& c) const
{
    const float pixel = lanes[c.lane].toPixels (c.x, c.y).x;
    const double from_hz = lanes[c.lane].xAt (pixel - 0.5f), to_hz = lanes[c.lane].xAt (pixel + 0.5f);
    std::optional<Cursor> nearest;
    for (std::size_t n = 0; n < lines.size(); ++n)
    {
        const double step_hz = lines[n].spectrum.step_hz;
        const auto& amplitude = lines[n].spectrum.amplitude;
        const auto count = std::ssize (amplitude), before = static_cast<std::ptrdiff_t> (c.x / step_hz);
        if (lines[n].lane != c.lane || n != c.curve.value_or (n) || before < 1 || before + 1 >= count) continue;
        const auto at = [&] (std::ptrdiff_t i) { return height (amplitude[static_cast<std::size_t> (i)]); };
        double y = std::lerp (at (before), at (before + 1), c.x / step_hz - static_cast<double> (before));
        auto i = static_cast<std::ptrdiff_t> (std::ceil (from_hz / step_hz));
        if (static_cast<double> (i) * step_hz <= to_hz) y = at (i);   // the curve keeps the highest of the lines that share a pixel
        for (; i < count && static_cast<double> (i) * step_hz <= to_hz; ++i)
            y = std::max (y, at (i));
        if (! nearest || std::abs (y - c.y) < std::abs (nearest->y - c.y)) nearest = Cursor { c.lane, c.x, y, n };
    }
    return nearest;
}

void SpectrumPlot::paintOver (juce::Graphics& g)
{
    const auto& area = lanes.front().area;
    const auto text = [] (double v, const std::string& unit) { return juce::String::fromUTF8 (withPrefix (v, unit).c_str()); };
    constexpr double least_peak = 1e-9;   // below, it is the rounding of a constant
    if (spec.cursors.empty() && highest && highest->amplitude > least_peak)
    {
        const auto corner = area.withTop (area.getBottom() - 48.0f).withWidth (std::min (132.0f, area.getWidth()));
        paintReadout (g, { filled (TRANS ("peak %1"), text (highest->hz, "Hz")), text (highest->amplitude, units.front()) }, corner);
    }
    if (missing == 0) return;
    g.setFont (lookOf (*this).font (11.0f));
    g.setColour (theme().warning);
    g.drawText (filled (missing == 1 ? TRANS ("%1 missed tick") : TRANS ("%1 missed ticks"), missing), area.reduced (8.0f, 4.0f).removeFromTop (14.0f),
                juce::Justification::topLeft, false);
}

juce::String SpectrumPlot::emptyText() const
{
    return spec.ports.empty() ? TRANS ("Select a wire and press P, or click + above, to plot its spectrum") : whyEmpty();
}

}   // namespace tactus::host
