// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/plain_button.hpp>
#include <host/app/look/tool_button.hpp>
#include <host/app/model/document.hpp>
#include <host/app/storage/snapshots.hpp>
#include <host/app/text/filled.hpp>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace tactus::host
{

/// The bar above the canvas. On the left, a breadcrumb trail: the graph and the subgraphs that were entered, each one a button that
/// leads back to it. On the right, snapshots, undo and redo, help, and the menu.
class TopBar final : public juce::Component
{
public:
    static constexpr int height = 40;

    explicit TopBar (Document&);
    ~TopBar() override;

    /// The instance of the current subgraph whose values are shown.
    struct Instance
    {
        int number = 0, count = 1;
    };

    /// Call after each change of the document or the trail.
    void show (std::vector<juce::String> trail, std::optional<Instance> = {});

    /// The file of the graph, and whether the graph was edited since it was saved: "oak.json, edited". Empty for a new graph.
    juce::String savedText() const;

    std::function<void (std::size_t depth)> onLeave;
    std::function<void (int number)> onRecall, onStore, onClear;   ///< receive the number of a snapshot, from 1
    std::function<void (int from, int to)> onMorph;                ///< receives two snapshots
    std::function<void (int instance)> onInstance;
    std::function<void()> onHelp;
    std::function<void (juce::Component& at)> onMenu;

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseMove (const juce::MouseEvent&) override;

private:
    class Slot;
    std::vector<juce::Rectangle<float>> places() const;
    void placeCaption (juce::Rectangle<int>);

    void openInstances();
    void openSnapshots (juce::Component& at, int first, int last);

    Document& document;
    std::optional<Instance> shown;
    ToolButton instance { "", ToolButton::Kind::framed, TRANS ("Choose the instance of this subgraph whose values are shown") };
    std::vector<juce::String> trail;
    int room = 0;                   // width available for the trail, in pixels
    juce::Rectangle<int> caption;   // of the snapshots; empty if there is no room for it
    std::array<std::unique_ptr<Slot>, snapshot_count> slots;
    ToolButton all_slots { TRANS ("Snapshots"), ToolButton::Kind::framed, TRANS ("Recall or store a snapshot") };   // in place of the slots in a narrow bar
    std::unique_ptr<IconButton> undo, redo, help, menu;
};

}   // namespace tactus::host
