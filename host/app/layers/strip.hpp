// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "fader.hpp"
#include "gain_text.hpp"
#include "meter_feed.hpp"
#include "mixer.hpp"
#include "sends.hpp"

#include <host/app/inspector/blocks/number_field.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/app/model/document.hpp>
#include <host/app/text/filled.hpp>

#include <array>

namespace tactus::host
{

/// The mixer that the strips belong to, and their callbacks.
struct MixerContext
{
    Document& document;
    const Catalogue& catalogue;
    MixerPlace place;
    std::function<void (const juce::String&)> hint;
    std::function<void (const std::string& patch, graph::Id)> select;
    std::function<void (int layer, int x, bool let_go)> drag;               ///< a strip is being dragged by its name; x is the position in its parent
    std::function<graph::Command (graph::Batch removal)> completeRemoval;   ///< extends the removal of a node, see Canvas; empty: nodes stay

    const graph::Node* node() const { return findMixer (document.graph(), place); }
    void perform (graph::Command c, bool goes_on = false) const { document.perform (std::move (c), goes_on ? graph::Step::joined : graph::Step::own); }

    /// Performs a command, or says why there is none.
    void perform (Result<graph::Command>) const;
};

/// A name that can be edited by a double click.
class NameLabel final : public juce::Label
{
public:
    void paint (juce::Graphics&) override;
};

/// A channel of a mixer.
class LayerStrip final : public juce::Component
{
public:
    static constexpr int width = 120, widest = 168;   ///< a strip is wider where there is room, for long names
    static constexpr int least_height = 180;          ///< a lower strip would have a fader that is too short to set

    LayerStrip (std::shared_ptr<const MixerContext>, int layer);

    void show();   ///< updates the strip from the graph
    void refresh (const Traces::Client&, double dt_s, bool with_spectrum);

    // What the user does.
    void setGain (const std::optional<Json>&, bool goes_on);
    void setValue (const std::string& param, const std::optional<Json>&, bool goes_on);
    void typeGain (const juce::String&);   ///< sets the gain, as if the user typed it: "-6 dB", "0.3 N"
    NumberField& gainField() noexcept { return gain_field; }
    void setGate (bool on);
    void sendTo (const std::string& sink);   ///< turns the send to an output on or off; "" adds a vibration motor
    void setSendGain (double decibels, bool goes_on);
    void rename (const juce::String&);
    const graph::Node* onlySource() const;
    void remove();

    const Meter& meter() const noexcept { return feed.meter; }
    const Bands& bands() const noexcept { return spectrum; }
    juce::String sourceText() const { return source.getButtonText(); }
    double shownGain() const noexcept { return gain; }
    bool isGateShown() const { return gate.getToggleState(); }
    juce::String sendText() const { return send.getButtonText(); }

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;

private:
    std::string pathOf (const std::string& param, int i) const { return context->place.path + '.' + param + '[' + std::to_string (i) + ']'; }
    double numberNow (const graph::Node&, const std::string& param, int of_layer) const;   // what a control sets, or else as written
    void flip (const std::string& param, bool is_on);
    void connectFields();
    void placeGains (juce::Rectangle<int>&);
    void showSwitches (const graph::Node&);
    void showSource();
    void showSends();
    void openSends();
    void nameControls (const juce::String&);
    UnityLevel unityLevel() const;

    std::shared_ptr<const MixerContext> context;
    int layer;
    NameLabel name;
    ToolButton source { "", ToolButton::Kind::plain };
    ToolButton close { juce::String::fromUTF8 ("\xc3\x97"), ToolButton::Kind::plain, TRANS ("Remove this layer and its wires") };
    ToolButton mute { TRANS ("M"), ToolButton::Kind::toggle, TRANS ("Mute this layer") },
        solo { TRANS ("S"), ToolButton::Kind::toggle, TRANS ("Solo: mute all layers that are not soloed") };
    ToolButton gate { TRANS ("C"), ToolButton::Kind::toggle, TRANS ("Contact: this layer is felt only while the tool touches") };
    ToolButton send { "", ToolButton::Kind::plain };
    Fader fader;
    NumberField gain_field { decibelSheet() }, priority, send_gain { decibelSheet() };
    std::vector<Send> sends;
    MeterFeed feed;
    double unity_peak = 0.0;      // the greatest level that the meter has shown in this run, at a gain of 1
    std::size_t fader_step = 0;   // the position of the history after the last change by the fader
    Bands spectrum;
    bool has_spectrum = false;   // the run has room for it
    juce::Rectangle<int> meter_area, spectrum_area, peak_area;
    graph::Id fed_by = 0;
    double gain = 1.0;
    bool heard = true, wired = false, moving = false;
    juce::String held_by;
    std::string driver;   // the output whose wire sets the gain
};

/// The master strip: the level of the mix, its ceiling, and the ducking of layers.
class MixStrip final : public juce::Component
{
public:
    static constexpr int width = 168;

    explicit MixStrip (std::shared_ptr<const MixerContext>);

    void show();
    /// `motors`: the inputs that the mix reaches. The strip shows the total of the first one, which is the force of the status line unless the guard acts.
    void refresh (const Traces::Client&, const std::vector<std::string>& motors, double dt_s);
    double reduction() const noexcept { return over_db; }
    const Meter& meter() const noexcept { return feed.meter; }
    const Meter& motorMeter() const noexcept { return motor.meter; }
    std::array<NumberField*, 2> fields() noexcept { return { &duck, &ceiling }; }

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    std::shared_ptr<const MixerContext> context;
    NumberField duck, ceiling;
    MeterFeed feed, motor;
    juce::String peak, motor_peak;   // motor_peak: "" if no motor is behind the mixer
    double over_db = 0.0;
    bool limits = false;
    juce::Rectangle<int> meter_area, duck_label, ceiling_label, text_area;
};

}   // namespace tactus::host
