// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>
#include <host/app/model/document.hpp>

namespace tactus::host
{

/// The undo history, newest step at the bottom. A click goes to a step; undone steps stay in the list until the next edit.
class HistoryPanel final : public juce::Component, private Document::Listener, private juce::ListBoxModel
{
public:
    explicit HistoryPanel (Document&);
    ~HistoryPanel() override;

    void goToRow (int row);   ///< 0 is the initial state

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    void documentChanged() override;
    int getNumRows() override { return static_cast<int> (document.history().size()) + 1; }
    void paintListBoxItem (int row, juce::Graphics&, int w, int h, bool selected) override;
    void listBoxItemClicked (int row, const juce::MouseEvent& e) override
    {
        if (e.mods.isLeftButtonDown()) goToRow (row);
    }
    juce::String getTooltipForRow (int row) override;
    juce::String getNameForRow (int row) override { return nameOfRow (row); }
    juce::String nameOfRow (int row) const;

    Document& document;
    juce::ListBox list { {}, this };
};

}   // namespace tactus::host
