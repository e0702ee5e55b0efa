// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/palette/search.hpp>

#include <functional>

#include <juce_gui_basics/juce_gui_basics.h>

namespace tactus::host
{

/// Lists all nodes by family, to be dragged to the canvas. A double click or Return adds one, too.
class NodeList final : public juce::Component, private juce::ListBoxModel
{
public:
    NodeList();

    std::function<std::vector<PaletteEntry> (const std::string& query)> onSearch;   ///< as searchPalette
    std::function<void (const std::string& type)> onAdd;
    std::function<void()> onLeave;   ///< called by Esc in the search, which also clears it

    void refresh();   ///< call when there may be other entries; searches again, at once or when the list is shown

    const std::vector<PaletteEntry>& entries() const noexcept { return found; }

    void paint (juce::Graphics&) override;
    void resized() override;
    void visibilityChanged() override;
    void mouseDrag (const juce::MouseEvent&) override;   ///< of a row

private:
    int getNumRows() override { return static_cast<int> (found.size()); }
    juce::String getNameForRow (int) override;
    juce::String getTooltipForRow (int) override;
    void paintListBoxItem (int row, juce::Graphics&, int w, int h, bool selected) override;
    void listBoxItemDoubleClicked (int row, const juce::MouseEvent&) override { add (row); }
    void returnKeyPressed (int row) override { add (row); }

    const PaletteEntry* entryAt (int row) const;   // null for a title
    void add (int row);
    void update();

    std::vector<PaletteEntry> found;
    bool is_stale = true;
    juce::TextEditor query;
    juce::ListBox list { {}, this };
};

}   // namespace tactus::host
