// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/canvas/canvas.hpp>
#include <host/app/inspector/inspector.hpp>
#include <host/app/layers/layers_panel.hpp>
#include <host/app/palette/palette.hpp>
#include <host/app/presets/browser.hpp>
#include <host/app/run/hand_view.hpp>
#include <host/app/run/safety_strip.hpp>
#include <host/app/window/splitter.hpp>
#include <host/app/window/tabs.hpp>
#include <host/app/window/top_bar.hpp>

namespace tactus::host
{

/// All of the window: the safety strip, presets, canvas, inspector, the hand, and a line that says what is under the pointer.
class MainView final : public juce::Component, private Document::Listener, private juce::Timer
{
public:
    explicit MainView (const Catalogue&);
    ~MainView() override;

    /// Opens a graph file; what is wrong with it is said in the line below.
    void open (const std::filesystem::path&);

    Document& document() noexcept { return *edited; }
    Canvas& canvas() noexcept { return *patching; }
    std::function<void (const juce::String&)> onTitle;

    void paint (juce::Graphics&) override;
    void resized() override;
    bool keyPressed (const juce::KeyPress&) override;

private:
    void documentChanged() override;
    void documentRefused (const Message&) override;
    void timerCallback() override;
    void show (graph::Graph, const std::filesystem::path&);
    void openPalette (juce::Point<float> at, std::optional<WireStart>);
    void say (const juce::String&);
    void save();

    const Catalogue& catalogue;
    std::unique_ptr<Document> edited;
    std::unique_ptr<Performance> performance;   // after the document, before what shows it
    SafetyStrip strip;
    HandView hand;
    Tabs left, bottom;
    Splitter left_edge { Splitter::Edge::right, 232, 160 }, right_edge { Splitter::Edge::left, 304, 220 }, bottom_edge { Splitter::Edge::top, 264, 140 };
    std::unique_ptr<TopBar> top;
    PresetBrowser* presets = nullptr;   // in the left tabs
    LayersPanel* layers = nullptr;      // in the bottom tabs
    std::unique_ptr<Canvas> patching;
    std::unique_ptr<Inspector> inspector;
    Palette palette;
    juce::String said;
    juce::TooltipWindow tooltips { this, 600 };
};

}   // namespace tactus::host
