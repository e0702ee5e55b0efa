// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "strip.hpp"

#include <host/app/run/performance.hpp>

namespace tactus::host
{

/// The layer mixers of a graph as a mixing desk: a strip for each layer, and the mix.
class LayersPanel final : public juce::Component, private Document::Listener
{
public:
    LayersPanel (Document&, Performance&, const Catalogue&);
    ~LayersPanel() override;

    void refresh();   ///< to be called many times a second; of no effect while it is not to be seen

    std::function<void (const std::string& patch, graph::Id node)> onSelect;
    std::function<void (const juce::String&)> onHint;

    void choose (std::size_t desk);   ///< of several
    const std::vector<DeskPlace>& desks() const noexcept { return all; }
    std::size_t layers() const noexcept { return strips.size(); }
    LayerStrip& layer (std::size_t i) { return *strips[i]; }
    MixStrip* mix() noexcept { return total.get(); }
    void add (const std::string& type);   ///< a layer with a node of that type; "" for an empty one
    void addDeskNow();

    void paint (juce::Graphics&) override;
    void paintOverChildren (juce::Graphics&) override;
    void resized() override;
    void visibilityChanged() override;

private:
    static constexpr int head_width = 136;

    void documentChanged() override { rebuild(); }
    void rebuild();
    void wish();
    void openMenu();
    void drag (int layer, int x, bool let_go);

    Document& document;
    const Catalogue& catalogue;
    Traces::Client traces;
    std::vector<DeskPlace> all;
    DeskPlace chosen;
    std::vector<std::unique_ptr<ToolButton>> names;   // of the desks
    ToolButton more { "+ layer", ToolButton::Kind::framed, "Add a layer, with a texture or vibration wired into it" };
    ToolButton first { "Add a mixer before the motor", ToolButton::Kind::framed };
    juce::String outlook;   // what adding a desk would do, or why there is no place for one
    juce::Viewport scroll;
    juce::Component row;   // of strips
    std::vector<std::unique_ptr<LayerStrip>> strips;
    std::unique_ptr<MixStrip> total;
    double refreshed_ms = 0.0;
    int refreshes = 0, drop_at = -1;
};

}   // namespace tactus::host
