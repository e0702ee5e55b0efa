// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "search.hpp"

#include <host/app/look/look.hpp>

#include <functional>

namespace tactus::host
{

/// A searchable list of node types, which may come in groups with titles. Return or a click chooses an entry; Esc or a click elsewhere closes the list.
class Palette final : public juce::Component, private juce::ListBoxModel, private juce::TextEditor::Listener, private juce::KeyListener
{
public:
    static constexpr int width = 420, highest = 400;

    Palette();

    enum class Finds
    {
        nodes,
        others   ///< such as commands or ports
    };

    /// Opens the palette at a point of its parent, with an empty query. `search` returns the entries for a query, and titles between them. The
    /// palette is as high as what it lists, up to `highest`.
    void open (juce::Point<int> at, PaletteSearch search, const juce::String& purpose, std::function<void (const std::string& type)> chosen,
               Finds = Finds::nodes);
    void close();

    const std::vector<PaletteEntry>& entries() const noexcept { return found; }

    void paint (juce::Graphics&) override;
    void resized() override;

private:
    int getNumRows() override { return static_cast<int> (found.size()); }
    juce::String getNameForRow (int) override;
    void paintListBoxItem (int row, juce::Graphics&, int w, int h, bool selected) override;
    void listBoxItemClicked (int row, const juce::MouseEvent& e) override
    {
        if (e.mods.isLeftButtonDown()) choose (row);
    }
    void textEditorTextChanged (juce::TextEditor&) override { update(); }
    void textEditorReturnKeyPressed (juce::TextEditor&) override { choose (list.getSelectedRow()); }
    void textEditorEscapeKeyPressed (juce::TextEditor&) override { close(); }
    void textEditorFocusLost (juce::TextEditor&) override;
    using juce::Component::keyPressed;
    bool keyPressed (const juce::KeyPress&, juce::Component*) override;
    void update();
    void fit();                ///< makes the palette as high as its entries
    int spaceAtTop() const;    ///< the space above the heading in the first row, which is scrolled out of view
    void showFrom (int row);   ///< scrolls so that this row is in view
    void choose (int row);
    bool isEntry (int row) const;          ///< false for titles
    void selectNear (int row, int step);   ///< selects the first entry from this row on, in this direction

    std::function<std::vector<PaletteEntry> (const std::string&)> search;
    std::function<void (const std::string&)> on_chosen;
    std::vector<PaletteEntry> found;
    juce::String purpose;
    Finds finds = Finds::nodes;
    juce::TextEditor query;
    juce::ListBox list { {}, this };
};

}   // namespace tactus::host
