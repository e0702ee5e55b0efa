// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "strip.hpp"
#include "strip_view.hpp"
#include "unmixed_strip.hpp"

#include <host/app/text/filled.hpp>

#include <filesystem>

namespace tactus::host
{

/// A layer mixer of the graph as a mixing desk: a strip for each layer, one for each signal that reaches the motor past it, and the master strip. A clip
/// file or a preset dropped on it becomes a layer.
class LayersPanel final : public juce::Component, public juce::FileDragAndDropTarget, public juce::DragAndDropTarget, private Document::Listener
{
public:
    LayersPanel (Document&, Traces&, const Catalogue&);
    ~LayersPanel() override;

    void refresh();   ///< call many times a second

    std::function<void (const std::string& patch, graph::Id node)> onSelect;
    std::function<void (const std::string& patch, graph::Id node)> onAdded;   ///< receives the node of a layer that the user has just added
    std::function<void (const juce::String&)> onHint;
    std::function<void (const std::filesystem::path& file)> onPresetDropped;
    /// Asks for the file of a new clip layer. Nothing is added if the user chooses none. If this is not set, the layer begins without a file.
    std::function<void (std::function<void (const std::filesystem::path&)> chosen)> onChooseClip;

    /// Extends the removal of a node by what was made for it, see Canvas. Without it, the node of a removed layer stays.
    std::function<graph::Command (graph::Batch removal)> completeRemoval;

    /// The edit that makes a layer of a signal. Must be set before mixIn().
    std::function<Result<graph::Command> (const UnmixedSignal&)> commandToMix;

    void choose (std::size_t mixer);   ///< selects the mixer to show, if there are several
    const std::vector<MixerPlace>& mixers() const noexcept { return all; }
    std::size_t layers() const noexcept { return strips.size(); }
    LayerStrip& layer (std::size_t i) { return *strips[i]; }
    MixStrip* mix() noexcept { return total.get(); }
    const std::vector<std::unique_ptr<UnmixedStrip>>& unmixed() const noexcept { return past; }
    void mixIn (const UnmixedSignal&);   ///< makes a layer of it
    /// Adds a layer with a node of that type, "" for an empty one; adds a mixer first if there is none. A clip plays this file at each tap.
    void add (const std::string& type, const std::filesystem::path& clip = {});
    void begin (const std::string& type);   ///< like add(), but asks for the file of a clip first
    void addMixerNow();

    /// Adds a layer that plays a clip file, with this gain in N, or a gentle one. Without a mixer, adds one first, in the same step.
    void addClip (const std::filesystem::path& file, std::optional<double> gain = {});

    bool isInterestedInFileDrag (const juce::StringArray&) override;
    void fileDragEnter (const juce::StringArray&, int, int) override;
    void fileDragExit (const juce::StringArray&) override;
    void filesDropped (const juce::StringArray&, int, int) override;
    bool isInterestedInDragSource (const SourceDetails&) override;
    void itemDragEnter (const SourceDetails&) override { showDrop (TRANS ("Drop it to add it to this graph, as a node and a layer.")); }
    void itemDragExit (const SourceDetails&) override { endDrop(); }
    void itemDropped (const SourceDetails&) override;

    bool keyPressed (const juce::KeyPress&) override;   ///< Ctrl+Left and Ctrl+Right go to the same part of the strip beside
    void paint (juce::Graphics&) override;
    void paintOverChildren (juce::Graphics&) override;
    void resized() override;
    void visibilityChanged() override;

private:
    static constexpr int head_width = 184;

    void documentChanged() override { rebuild(); }
    void typesChanged() override { rebuildStrips (strips.size()); }   // their fields point into the datasheet of the mixer
    void rebuild();
    void proposeMixer();
    void rebuildNames();
    void rebuildStrips (std::size_t layers);
    void rebuildUnmixed();
    void placeStrips();
    void showNewest();
    void requestTraces();
    void openMenu();
    void layOutHead (juce::Rectangle<int>);
    juce::Rectangle<int> introductionArea() const;
    juce::AttributedString introductionText (int parts) const;
    void layOutIntroduction();
    void drag (int layer, int x, bool let_go);
    void showDrop (const juce::String& hint);
    void endDrop();

    Document& document;
    const Catalogue& catalogue;
    Traces::Client traces;    // the levels
    Traces::Client spectra;   // as many as fit into the record
    std::vector<MixerPlace> all;
    MixerPlace chosen;
    std::vector<std::unique_ptr<ToolButton>> names;   // one button for each mixer
    std::vector<std::unique_ptr<ToolButton>> kinds;   // one button for each kind of layer
    ToolButton more { TRANS ("Other layer..."), ToolButton::Kind::framed, TRANS ("Add an empty layer, or one with another texture or vibration") };
    ToolButton first { TRANS ("Add a mixer before the motor"), ToolButton::Kind::framed };
    juce::String preview;         // what adding a mixer would do, or why it is not possible
    int introduction_parts = 0;   // of the text about mixers; a small panel has room for fewer
    StripView scroll;
    juce::Component row;   // contains the strips
    std::vector<std::unique_ptr<LayerStrip>> strips;
    BehindMixer behind;
    std::vector<std::unique_ptr<UnmixedStrip>> past;
    std::unique_ptr<MixStrip> total;
    double refreshed_ms = 0.0;
    int refreshes = 0, drop_at = -1, strip_width = LayerStrip::width;
    bool file_over = false;   // a clip file is being dragged over the desk
};

}   // namespace tactus::host
