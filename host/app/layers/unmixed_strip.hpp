// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "meter_feed.hpp"
#include "mixer.hpp"

#include <host/app/look/tool_button.hpp>

#include <tactus/plan/flat/flat.hpp>

namespace tactus::host
{

/// A signal that reaches a motor past the mixers.
struct UnmixedSignal
{
    std::string from, sink, port;   ///< "wall.force", and the path and the input of the motor
    double gain = 1.0;              ///< of the wire

    bool operator== (const UnmixedSignal&) const = default;
};

/// The motors behind a mixer.
struct BehindMixer
{
    std::vector<std::string> motors {};      ///< the inputs that its mix reaches: "motor.force"
    std::vector<UnmixedSignal> unmixed {};   ///< the signals that reach these motors, or one without a mixer, and that no mixer mixes

    bool operator== (const BehindMixer&) const = default;
};

/// The motors and the unmixed signals behind a mixer. An instance of a mixer in a subgraph counts as the mixer.
BehindMixer behindMixer (const graph::Graph&, const MixerPlace&, const Catalogue&);

/// The strip of such a signal: its level, and a button that makes it a layer. Mute, solo and gains do not reach it.
class UnmixedStrip final : public juce::Component
{
public:
    UnmixedStrip (UnmixedSignal, std::function<void()> mix_in);

    void refresh (const Traces::Client&, double dt_s);
    const Meter& meter() const noexcept { return feed.meter; }
    const UnmixedSignal& signal() const noexcept { return of; }

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    UnmixedSignal of;
    ToolButton mix { TRANS ("Mix it in"), ToolButton::Kind::framed, TRANS ("Make a layer of this signal, in a mixer before the motor") };
    MeterFeed feed;
    juce::Rectangle<int> name_area, note_area, meter_area, peak_area;
};

}   // namespace tactus::host
