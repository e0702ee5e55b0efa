// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/desk/desk.hpp>
#include <host/app/look/plain_button.hpp>
#include <host/app/look/tool_button.hpp>
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

    explicit TopBar (Desk&);
    ~TopBar() override;

    void show();   ///< call after each change of the document, or of the patch that the canvas shows, and after each drag on the canvas

    /// The file of the graph, and whether the graph was edited since it was saved: "oak.json, edited". Empty for a new graph.
    const juce::String& savedText() const noexcept { return saved; }

    juce::String graphName() const;
    /// Each snapshot from `first` to `last` that is stored can be recalled and cleared, and each can be stored. A single one can be morphed to another.
    void fillSnapshotMenu (juce::PopupMenu&, int first, int last);
    bool snapshotKey (const juce::KeyPress&);   ///< a digit recalls a snapshot or stores it, and V compares; false for other keys

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
    void showSaved();   // compares the graph with its file, which takes longer than all else that is shown

    void recall (int snapshot);   // from 1
    void store (int snapshot);
    int otherSnapshot() const;
    void compare();   // recalls the snapshot before the last one
    void morph (int from, int to);
    void note (int snapshot);
    void openInstances();
    void openSnapshots (juce::Component& at, int first, int last);

    Desk& desk;
    Document& document { desk.document };
    std::optional<Canvas::Instance> shown;
    std::array<int, 2> compared {};      // the last two snapshots; 0: none
    const void* compared_in = nullptr;   // identity of their document
    ToolButton instance { "", ToolButton::Kind::framed, TRANS ("Choose the instance of this subgraph whose values are shown") };
    std::vector<juce::String> trail;
    juce::String saved;
    int room = 0;                   // width available for the trail, in pixels
    juce::Rectangle<int> caption;   // of the snapshots; empty if there is no room for it
    std::array<std::unique_ptr<Slot>, snapshot_count> slots;
    ToolButton all_slots { TRANS ("Snapshots"), ToolButton::Kind::framed, TRANS ("Recall or store a snapshot") };   // in place of the slots in a narrow bar
    std::unique_ptr<IconButton> undo, redo, help, menu;
};

}   // namespace tactus::host
