// SPDX-License-Identifier: GPL-3.0-or-later
#include "strip.hpp"

#include <host/app/model/param_now.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

MixStrip::MixStrip (std::shared_ptr<const MixerContext> c)
    : context (std::move (c)), duck (mixerSheet (context->catalogue, "duck_db")), ceiling (mixerSheet (context->catalogue, "ceiling"))
{
    const auto bind = [this] (NumberField& field, const char* param) {
        field.onChange = [this, param] (std::optional<Json> to, bool continues) {
            const auto& at = context->place;
            context->perform (graph::SetParam { at.patch, at.node, param, std::move (to) }, continues);
        };
        field.onRefused = context->hint;
        addAndMakeVisible (field);
    };
    duck.setTitle (TRANS ("Ducking in dB"));
    ceiling.setTitle (TRANS ("Ceiling of the mix"));
    bind (duck, "duck_db");
    bind (ceiling, "ceiling");
    show();
}

void MixStrip::show()
{
    const auto* node = context->node();
    if (node == nullptr) return;
    const auto value = [&] (const char* param) {
        const auto own = node->params.find (param);
        return own != node->params.end() ? Json (*own) : Json (mixerSheet (context->catalogue, param).initial[0]);
    };
    duck.setDriver (driverAt (context->document.graph(), context->place.path + ".duck_db"));
    ceiling.setDriver (driverAt (context->document.graph(), context->place.path + ".ceiling"));
    duck.show (value ("duck_db"));
    duck.setBold (node->params.contains ("duck_db"));
    ceiling.show (value ("ceiling"));
    ceiling.setBold (node->params.contains ("ceiling"));
    limits = ceiling.shown().si() > 0.0;
    for (int i = 0; feed.unit.empty() && i < layersOf (*node, context->catalogue); ++i)
        feed.unit = unitOfLayer (context->document.graph(), context->place, context->catalogue, i);
    repaint();
}

void MixStrip::refresh (const Traces::Client& traces, const std::vector<std::string>& motors, double dt_s)
{
    const auto before = over_db;
    const auto before_motor = std::exchange (motor_peak, juce::String());
    if (! motors.empty())
    {
        motor.take (traces.of (motors.front()), 1.0, dt_s);
        motor_peak = levelText (motor.meter.peak(), motor.unit);
    }
    feed.take (traces.of (context->place.path + ".out"), 1.0, dt_s);
    const auto shown_peak = std::exchange (peak, levelText (feed.meter.peak(), feed.unit));
    over_db = 0.0;
    const bool is_heard = feed.meter.rms() > 0.0;   // the traces of a run stay after it
    if (const auto found = traces.of (context->place.path + ".reduction"); is_heard && ! found.empty())
    {
        std::vector<double> latest;
        latestOf (*found.front(), static_cast<std::size_t> (0.3 * found.front()->rate()), 1.0, latest);
        for (const double v : latest)
            if (v > over_db) over_db = v;
    }
    repaint (meter_area);
    if (before != over_db || shown_peak != peak || before_motor != motor_peak) repaint (text_area);
}

void MixStrip::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.canvas.interpolatedWith (theme.panel, 0.5f));
    auto area = getLocalBounds().reduced (12, 4).toFloat();
    g.setFont (look.font (13.0f, true));
    g.setColour (theme.text);
    g.drawText (TRANS ("Mix"), area.removeFromTop (24.0f), juce::Justification::centredLeft, false);
    const bool over = over_db > 0.05;
    paintMeter (g, meter_area.toFloat(), feed.meter, over ? theme.warning : inkOf (feed.quantity, theme), look, feed.unit);
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    g.drawText (TRANS ("ducking"), duck_label, juce::Justification::centredLeft, false);
    g.drawText (feed.unit.empty() ? TRANS ("ceiling") : filled (TRANS ("ceiling (%1)"), feed.unit), ceiling_label, juce::Justification::centredLeft, false);
    auto drawLine = [&, lines = text_area] (const juce::String& text) mutable {   // a long number is drawn narrower, not without its unit
        g.drawFittedText (text, lines.removeFromTop (18), juce::Justification::centredLeft, 1, 0.6f);
    };
    g.setColour (theme.text);
    drawLine (filled (TRANS ("peak %1"), peak));
    if (motor_peak.isNotEmpty()) drawLine (filled (TRANS ("asked %1"), motor_peak));
    auto state = limits ? TRANS ("below the ceiling") : TRANS ("no ceiling");
    if (limits && feed.meter.peak() > 0.99 * ceiling.shown().si()) state = TRANS ("at the ceiling");
    if (limits && over) state = filled (TRANS ("over by %1 dB"), juce::String (over_db, 1));
    g.setColour (over ? theme.warning : theme.dim);
    drawLine (state);
}

void MixStrip::resized()
{
    auto area = getLocalBounds().reduced (12, 4).withTrimmedTop (28);
    meter_area = area.removeFromLeft (60);
    area.removeFromLeft (4);
    const bool tall = area.getHeight() >= 148;
    duck_label = tall ? area.removeFromTop (16) : juce::Rectangle<int>();
    duck.setBounds (area.removeFromTop (24));
    area.removeFromTop (4);
    ceiling_label = tall ? area.removeFromTop (16) : juce::Rectangle<int>();
    ceiling.setBounds (area.removeFromTop (24));
    area.removeFromTop (4);
    text_area = area;
}

}   // namespace tactus::host
