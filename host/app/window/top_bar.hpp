// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plain_button.hpp"

#include <host/app/keep/snapshots.hpp>

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace tactus::host
{

/// Where one is: the name of the graph, and the subgraphs that were entered, each a button that leads back out. At the right
/// the snapshots, undo and redo, help and the menu.
class TopBar final : public juce::Component
{
public:
    static constexpr int height = 40;

    struct State
    {
        std::vector<juce::String> way;
        bool changed = false;
        juce::String undo, redo;   ///< the steps that these would take; empty: none
        std::array<bool, snapshot_count> snapshots {};
    };

    TopBar();
    ~TopBar() override;

    void show (State);

    std::function<void (std::size_t depth)> onLeave;
    std::function<void (int number)> onRecall, onStore;   ///< of a snapshot, from 1
    std::function<void()> onUndo, onRedo, onHelp;
    std::function<void (juce::Component& at)> onMenu;

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseUp (const juce::MouseEvent&) override;
    void mouseMove (const juce::MouseEvent&) override;

private:
    class Slot;
    std::vector<juce::Rectangle<float>> places() const;

    State state;
    int room = 0;   // pixels, at the left
    std::array<std::unique_ptr<Slot>, snapshot_count> slots;
    std::unique_ptr<IconButton> undo, redo, help, menu;
};

}   // namespace tactus::host
