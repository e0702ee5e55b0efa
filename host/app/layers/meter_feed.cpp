// SPDX-License-Identifier: GPL-3.0-or-later
#include "meter_feed.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/with_prefix.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr double rms_s = 0.1, spectrum_s = 0.5;
constexpr std::size_t longest_spectrum = 4096;

/// The latest samples of a port: for a number with its sign, for a vector its length.
void latestLevels (const PortTraces& traces, std::size_t n, double factor, std::vector<double>& into)
{
    latestOf (*traces.front(), n, factor, into);
    if (traces.size() < 2) return;
    std::vector<double> part;
    for (auto& v : into)
        v *= v;
    for (std::size_t c = 1; c < traces.size(); ++c)
    {
        latestOf (*traces[c], n, factor, part);
        for (std::size_t i = 0; i < std::min (into.size(), part.size()); ++i)
            into[i] += part[i] * part[i];
    }
    for (auto& v : into)
        v = std::sqrt (v);
}

/// The marks of a scale, from the top: "10 N", "1 N", "0.1 N", "10 mN". If one of them does not fit with its unit, only the first one has it: "10 rad/s", "1".
std::array<std::pair<double, juce::String>, 5> scaleMarks (const std::string& unit, const std::function<bool (const juce::String&)>& fits)
{
    std::array<std::pair<double, juce::String>, 5> marks { { { 10.0, "10" }, { 1.0, "1" }, { 0.1, "0.1" }, { 0.01, "0.01" }, { 0.001, "0.001" } } };
    if (unit.empty() || unit == "1") return marks;
    auto whole = marks;
    for (auto& [level, text] : whole)
        text = level < 0.05 ? fromUtf8 (withPrefix (level, unit, level < 0.005 ? 1 : 2)) : text + " " + fromUtf8 (unit);
    const auto isTooWide = [&] (const auto& mark) { return ! fits (mark.second); };
    if (std::ranges::none_of (whole, isTooWide)) return whole;
    marks.front().second << " " << fromUtf8 (unit);
    return marks;
}
}   // namespace

juce::Colour inkOf (Quantity q, const Theme& theme) { return q == Quantity::any ? theme.dim : theme.of (q); }

void latestOf (const Trace& trace, std::size_t n, double factor, std::vector<double>& into)
{
    const auto from = std::max (trace.begin(), trace.end() - std::min<std::uint64_t> (trace.end(), n));
    into.clear();
    for (auto k = from; k < trace.end(); ++k)
        into.push_back (factor * trace.at (k));
}

Bands bandsOfPort (const PortTraces& traces, double factor)
{
    Bands sum;
    std::vector<double> samples;
    for (const auto& trace : traces)
    {
        std::size_t n = 256;
        while (n < longest_spectrum && static_cast<double> (n) < spectrum_s * trace->rate())
            n *= 2;
        latestOf (*trace, n, factor, samples);
        const auto bands = bandsOf (samples, trace->rate());
        for (std::size_t b = 0; b < sum.power.size(); ++b)
            sum.power[b] += bands.power[b];
    }
    return sum;
}

bool MeterFeed::take (const PortTraces& traces, double factor, double dt_s)
{
    const bool is_first = ! std::exchange (has_begun, true);
    latest.clear();
    newest = 0.0;
    has_changed = false;
    std::size_t fresh = 0;
    if (! traces.empty())
    {
        const auto& trace = *traces.front();
        unit = trace.unit();
        quantity = trace.quantity();
    }
    if (! traces.empty() && traces.front()->begin() < traces.front()->end())
    {
        const auto& trace = *traces.front();
        // Another trace of the same run, such as after a time in which fewer ports were recorded, continues.
        const bool is_same = of.lock() == traces.front();
        has_changed = is_first || trace.end() < seen || (is_same ? beginnings > 0 && trace.beginnings() != beginnings : trace.begin() < seen);
        of = traces.front();
        beginnings = trace.beginnings();
        if (has_changed)
        {
            meter = {};
            seen = is_first ? trace.end() : trace.begin();
        }
        fresh = trace.end() > seen ? static_cast<std::size_t> (trace.end() - seen) : 0;
        // Without new samples, the level is zero.
        if (fresh > 0) latestLevels (traces, static_cast<std::size_t> (rms_s * trace.rate()), 1.0, latest);
        for (std::size_t i = latest.size() - std::min (fresh, latest.size()); i < latest.size(); ++i)
            if (std::isfinite (latest[i])) newest = std::max (newest, std::abs (latest[i]));
        for (auto& v : latest)
            v *= factor;
        seen = trace.end();
    }
    meter.take (latest, fresh, dt_s);
    return ! traces.empty();
}

juce::String levelText (double level, const std::string& unit)
{
    if (! (level >= 1e-6)) return juce::String::fromUTF8 ("\xe2\x80\x93");
    return fromUtf8 (withPrefix (level, unit.empty() ? "1" : unit));
}

void paintMeter (juce::Graphics& g, juce::Rectangle<float> area, const Meter& meter, juce::Colour colour, const Look& look, const std::string& unit)
{
    const auto& theme = look.theme();
    const auto bar = area.removeFromLeft (10.0f);
    g.setColour (theme.canvas);
    g.fillRoundedRectangle (bar, 2.0f);
    g.setColour (theme.hairline);
    g.drawRoundedRectangle (bar.reduced (0.5f), 2.0f, 1.0f);
    const auto yOf = [&] (double level) { return bar.getBottom() - bar.getHeight() * static_cast<float> (meterPosition (level)); };
    g.setColour (colour);
    g.fillRoundedRectangle (bar.reduced (1.5f, 1.0f).withTop (std::min (bar.getBottom() - 1.0f, yOf (meter.rms()))), 1.5f);
    if (meter.peak() > 1e-3) g.fillRect (bar.withHeight (2.0f).withCentre ({ bar.getCentreX(), std::max (bar.getY() + 1.0f, yOf (meter.peak())) }));

    const auto font = look.font (11.0f);
    const float room = area.getWidth() - 8.0f;
    const auto marks = scaleMarks (unit, [&] (const juce::String& text) { return font.getStringWidthFloat (text) <= room; });
    g.setFont (font);
    float last = -100.0f;
    for (const auto& [level, text] : marks)
    {
        const float y = std::clamp (yOf (level), bar.getY() + 5.0f, bar.getBottom() - 5.0f);
        if (y - last < 12.0f) continue;
        last = y;
        g.setColour (theme.hairline);
        g.fillRect (area.getX() + 2.0f, yOf (level) - 0.5f, 4.0f, 1.0f);
        g.setColour (theme.dim);
        g.drawText (text, juce::Rectangle<float> (area.getX() + 8.0f, y - 7.0f, room, 14.0f), juce::Justification::centredLeft, false);
    }
}

}   // namespace tactus::host
