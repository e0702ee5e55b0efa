// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "bands.hpp"
#include "desk.hpp"
#include "fader.hpp"
#include "meter.hpp"

#include <host/app/inspector/number_field.hpp>
#include <host/app/inspector/tool_button.hpp>
#include <host/app/model/document.hpp>
#include <host/app/run/traces.hpp>

namespace tactus::host
{

/// The desk that strips belong to, and what they ask of those around it.
struct DeskContext
{
    Document& document;
    const Catalogue& catalogue;
    DeskPlace place;
    std::function<void (const juce::String&)> hint;
    std::function<void (const std::string& patch, graph::Id)> select;
    std::function<void (int layer, int x, bool let_go)> drag;   ///< of a strip by its name, to an x in its parent

    const graph::Node* node() const { return findDesk (document.graph(), place); }
    void perform (graph::Command c, bool goes_on = false) const { document.perform (std::move (c), goes_on ? graph::Step::joined : graph::Step::own); }
};

/// What a meter has seen, from a trace.
struct MeterFeed
{
    Meter meter;
    std::string unit;
    Quantity quantity = Quantity::any;

    /// True if there is something to be seen. `factor` is what the level is multiplied with on its way.
    bool take (const std::vector<std::shared_ptr<const Trace>>&, double factor, double dt_s);

private:
    std::uint64_t seen = 0;
    std::vector<double> latest;
};

/// A level as a bar, with its peak as a line; the scale has four decades, from a thousandth to ten.
void paintMeter (juce::Graphics&, juce::Rectangle<float>, const Meter&, juce::Colour, const Look&, bool with_scale);

/// "0.42 N"; "–" of nothing.
juce::String levelText (double level, const std::string& unit);

/// A name that is edited after a double click.
class NameLabel final : public juce::Label
{
public:
    void paint (juce::Graphics&) override;
};

/// A channel of a desk.
class LayerStrip final : public juce::Component
{
public:
    static constexpr int width = 112;

    LayerStrip (std::shared_ptr<const DeskContext>, int layer);

    void show();   ///< as the graph has it
    void refresh (const Traces::Client&, double dt_s, bool with_spectrum);

    // What a hand does at it.
    void setGain (std::optional<Json>, bool goes_on);
    void setValue (const std::string& param, std::optional<Json>, bool goes_on);
    void rename (const juce::String&);
    void remove();

    const Meter& meter() const noexcept { return feed.meter; }
    const Bands& bands() const noexcept { return spectrum; }
    juce::String sourceText() const { return source.getButtonText(); }
    double shownGain() const noexcept { return gain; }

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;

private:
    std::string pathOf (const std::string& param) const { return context->place.path + '.' + param + '[' + std::to_string (layer) + ']'; }
    bool isOn (const graph::Node&, const std::string& param) const;
    double numberOf (const graph::Node&, const std::string& param) const;

    std::shared_ptr<const DeskContext> context;
    int layer;
    NameLabel name;
    ToolButton source { "", ToolButton::Kind::plain }, close { juce::String::fromUTF8 ("\xc3\x97"), ToolButton::Kind::plain, "Remove this layer and its wires" };
    ToolButton mute { "M", ToolButton::Kind::toggle, "Mute: this layer is silent" }, solo { "S", ToolButton::Kind::toggle, "Solo: only layers in solo are heard" };
    Fader fader;
    NumberField gain_field, priority;
    MeterFeed feed;
    Bands spectrum;
    juce::Rectangle<int> meter_area, spectrum_area, peak_area;
    graph::Id fed_by = 0;
    double gain = 1.0;
    bool heard = true, wired = false, moving = false;
    juce::String held_by;
};

/// What all layers come to: the mix, its ceiling, and how far layers are ducked.
class MixStrip final : public juce::Component
{
public:
    static constexpr int width = 168;

    explicit MixStrip (std::shared_ptr<const DeskContext>);

    void show();
    void refresh (const Traces::Client&, double dt_s);
    double reduction() const noexcept { return over_db; }

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    std::shared_ptr<const DeskContext> context;
    NumberField duck, ceiling;
    MeterFeed feed;
    juce::String peak;
    double over_db = 0.0;
    bool limits = false;
    juce::Rectangle<int> meter_area, duck_label, ceiling_label, words;
};

}   // namespace tactus::host
