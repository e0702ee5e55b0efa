// SPDX-License-Identifier: GPL-3.0-or-later
#include "unmixed_strip.hpp"

#include <host/app/text/filled.hpp>
#include <host/tools/stems/sink_mixes.hpp>

#include <tactus/plan/flat/flatten.hpp>

#include <algorithm>
#include <cmath>

namespace tactus::host
{

BehindMixer behindMixer (const graph::Graph& g, const MixerPlace& at, const Catalogue& catalogue)
{
    BehindMixer found;
    const auto flat = plan::flatten (g, catalogue, {}, nullptr, plan::SettingFiles::left_out).flat;
    for (const auto& m : sinkMixes (flat))
    {
        const bool is_behind = std::ranges::any_of (m.mixers, [&] (int n) { return flat.node (n).identity.id == at.id; });
        if (is_behind) found.motors.push_back (m.name);
        if (! is_behind && ! m.mixers.empty()) continue;
        for (const auto& u : m.unmixed)
            if (! u.from.empty())
                found.unmixed.push_back ({ u.from, flat.node (m.sink).path, std::string (flat.sheet (m.input).id), flat.wires[u.wire].gain });
    }
    return found;
}

UnmixedStrip::UnmixedStrip (UnmixedSignal s, std::function<void()> mix_in) : of (std::move (s))
{
    setTitle (filled (TRANS ("%1, not mixed"), of.from));
    mix.setTitle (filled (TRANS ("Mix %1 in"), of.from));
    mix.onClick = std::move (mix_in);
    addAndMakeVisible (mix);
}

void UnmixedStrip::refresh (const Traces::Client& traces, double dt_s)
{
    feed.take (traces.of (of.from), std::abs (of.gain), dt_s);
    repaint();
}

void UnmixedStrip::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.setColour (theme.hairline);
    g.fillRect (getLocalBounds().removeFromRight (1));
    g.setFont (look.font (13.0f, true));
    g.setColour (theme.text);
    g.drawText (of.from, name_area, juce::Justification::centredLeft, true);
    g.setFont (look.font (12.0f));
    g.setColour (theme.warning);
    g.drawText (TRANS ("not mixed"), note_area, juce::Justification::centredLeft, true);
    paintMeter (g, meter_area.toFloat(), feed.meter, inkOf (feed.quantity, theme), look, feed.unit);
    g.setFont (look.font (11.0f));
    g.setColour (theme.dim);
    drawNumber (g, levelText (feed.meter.peak(), feed.unit), peak_area.toFloat());
}

void UnmixedStrip::resized()
{
    auto area = getLocalBounds().withTrimmedRight (1).reduced (8, 4);
    name_area = area.removeFromTop (24);
    note_area = area.removeFromTop (20);
    mix.setBounds (area.removeFromBottom (24));
    area.removeFromBottom (4);
    auto right = area.removeFromRight (60);
    peak_area = area.getHeight() >= 60 ? right.removeFromBottom (16).withTrimmedTop (2) : juce::Rectangle<int>();
    meter_area = right.withTrimmedLeft (4);
}

}   // namespace tactus::host
