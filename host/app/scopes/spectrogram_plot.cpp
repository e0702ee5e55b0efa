// SPDX-License-Identifier: GPL-3.0-or-later
#include "spectrogram_plot.hpp"

#include <host/app/model/with_prefix.hpp>
#include <host/app/text/filled.hpp>
#include <host/tools/figures/colours.hpp>

#include <cmath>

namespace tactus::host
{

SpectrogramPlot::SpectrogramPlot (ScopeSpec& s, ScopeContext& c) : ScopePlot (s, c) { setTitle (TRANS ("Spectrogram")); }

Extent SpectrogramPlot::frequencies (double rate_hz) const
{
    const double half = 0.5 * rate_hz, top = spec.up_to_hz > 0.0 ? std::min (spec.up_to_hz, half) : half;
    const auto zoomed = spec.zoomed.find ("Hz");
    if (zoomed == spec.zoomed.end()) return { 0.0, top };
    const Extent inside { std::clamp (zoomed->second.low, 0.0, half), std::clamp (zoomed->second.high, 0.0, half) };
    return inside.size() > 1.0 ? inside : Extent { 0.0, top };
}

void SpectrogramPlot::show (const Signals& signals)
{
    const auto traces = spec.ports.empty() ? TraceList {} : signals (spec.ports.front());
    if (traces.empty() || traces.front()->begin() == traces.front()->end())
    {
        lanes.clear();
        scrolling.clear();
        return repaint();
    }
    unit = traces.front()->unit();
    layOut ({ "Hz" });
    auto& lane = lanes.front();
    lane.area.setWidth (std::max (1.0f, lane.area.getWidth() - bar_room));
    lane.x = { -spec.seconds, 0.0 };
    lane.x_unit = "s";
    lane.y = frequencies (traces.front()->rate());
    const auto before = scrolling.columns();
    scrolling.update (traces, { juce::roundToInt (lane.area.getWidth()), juce::roundToInt (lane.area.getHeight()), spec.seconds, lane.y });
    if (scrolling.columns() == before) return;   // nothing new, for example while it is frozen; a change of size repaints anyway
    describe (unit);
    repaint();
}

/// For those who cannot see the colours.
void SpectrogramPlot::describe (const std::string& si)
{
    constexpr int refreshes = 30;   // about a second: faster speech could not be followed
    if (since_described++ % refreshes != 0) return;
    const auto loudest =
        filled (TRANS ("loudest at %1 Hz, %2 dB re 1 %3"), juce::String (scrolling.loudestHz(), 0), juce::String (scrolling.loudestDb(), 0), si);
    setDescription (scrolling.loudestHz() > 0.0 ? loudest : TRANS ("silent"));
}

ScopePlot::Action SpectrogramPlot::rangeAction()
{
    const auto open = [this] (juce::Component& below) {
        juce::PopupMenu menu;
        const auto add = [&] (const juce::String& label, double hz) {
            menu.addItem (label, true, spec.up_to_hz == hz && ! spec.zoomed.contains ("Hz"), [safe = juce::Component::SafePointer (this), hz] {
                if (safe == nullptr) return;
                safe->spec.up_to_hz = hz;
                safe->spec.zoomed.erase ("Hz");
                if (safe->context.onChange) safe->context.onChange();
            });
        };
        for (const double hz : { 200.0, 500.0, 1000.0, 2000.0, 5000.0 })
            add (filled (TRANS ("up to %1"), withPrefix (hz, "Hz", 1)), hz);
        add (TRANS ("up to half the rate"), 0.0);
        menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (below));
    };
    const auto shown = spec.up_to_hz > 0.0 ? filled (TRANS ("to %1"), withPrefix (spec.up_to_hz, "Hz", 1)) : TRANS ("to half the rate");
    return { shown, TRANS ("The highest frequency; Shift+wheel zooms, and a double click resets the zoom"), open };
}

std::vector<ScopePlot::Action> SpectrogramPlot::actions()
{
    return { lengthAction ({ 1.0, 2.0, 5.0, 10.0 }, TRANS ("How much of the past is shown; the wheel changes it too")), rangeAction() };
}

void SpectrogramPlot::paintLane (juce::Graphics& g, const Lane& lane, std::size_t) { scrolling.draw (g, lane.area); }

void SpectrogramPlot::paintOver (juce::Graphics& g)
{
    const auto& scale = scrolling.decibels();
    if (scale.isEmpty()) return;
    const auto& lane = lanes.front().area;
    auto bar = lane.withX (lane.getRight() + 8.0f).withWidth (10.0f);
    constexpr int steps = 48;
    const float step = bar.getHeight() / static_cast<float> (steps);
    for (int i = 0; i < steps; ++i)
    {
        const auto c = colourOfLevel ((i + 0.5) / steps);
        g.setColour (juce::Colour (c.red, c.green, c.blue));
        g.fillRect (bar.withTop (bar.getBottom() - static_cast<float> (i + 1) * step).withHeight (step + 0.6f));
    }
    g.setFont (lookOf (*this).font (11.0f));
    g.setColour (theme().dim);
    const juce::Rectangle<float> numbers (bar.getRight() + 2.0f, 0.0f, bar_room - 20.0f, 14.0f);
    for (const auto& tick : ticksWithin (scale, std::max (2, static_cast<int> (bar.getHeight() / 26.0f))))
    {
        const float y = bar.getBottom() - static_cast<float> ((tick.at - scale.low) / scale.size()) * bar.getHeight();
        const float inside = std::clamp (y - 7.0f, bar.getY(), bar.getBottom() - 14.0f);
        g.drawText (juce::String::fromUTF8 (tick.text.c_str()), numbers.withY (inside), juce::Justification::centredRight, false);
    }
    g.setColour (theme().text);
    const auto about = unit.empty() || unit == "1" ? juce::String ("dB") : filled (TRANS ("dB re 1 %1"), unit);
    g.drawText (about, juce::Rectangle<float> (bar.getX() - 30.0f, bar.getBottom() + 2.0f, bar_room + 30.0f, 14.0f), juce::Justification::centredRight, false);
}

juce::String SpectrogramPlot::emptyText() const
{
    return spec.ports.empty() ? TRANS ("Select a wire and press P, or click + above, to see which frequencies it has") : whyEmpty();
}

}   // namespace tactus::host
