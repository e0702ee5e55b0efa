// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/app/look/look.hpp>
#include <host/app/model/document.hpp>

namespace tactus::host
{

/// All that was done, by name, the latest at the bottom. A click goes there; what is undone by that stays until something
/// else is done.
class HistoryPanel final : public juce::Component, private Document::Listener, private juce::ListBoxModel
{
public:
    explicit HistoryPanel (Document&);
    ~HistoryPanel() override;

    void goToRow (int row);   ///< 0 is how it began

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    void documentChanged() override;
    int getNumRows() override { return static_cast<int> (names.size()) + 1; }
    void paintListBoxItem (int row, juce::Graphics&, int w, int h, bool selected) override;
    void listBoxItemClicked (int row, const juce::MouseEvent&) override { goToRow (row); }
    juce::String getTooltipForRow (int row) override;
    juce::String nameOfRow (int row) const;

    Document& document;
    std::vector<std::string> names;
    juce::ListBox list { {}, this };
};

}   // namespace tactus::host
