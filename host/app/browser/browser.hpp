// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "tag_chips.hpp"

#include <host/app/presets/picture_store.hpp>
#include <host/app/presets/preset_list.hpp>
#include <host/app/storage/settings.hpp>

#include <functional>

namespace tactus::host
{

/// Lists the user's own graphs, the latest first, and the presets, with a description and a force plot. A click opens one. One can be dragged
/// elsewhere.
class PresetBrowser final : public juce::Component, private juce::ListBoxModel, private juce::KeyListener
{
public:
    PresetBrowser (const Catalogue&, Settings&, PictureStore&);

    std::function<void (const Preset&, bool is_own)> onOpen;
    std::function<void (const Preset&)> onAdd;                 ///< Ctrl+Return: it is added to the open graph
    std::function<void (const Preset&, bool is_own)> onMenu;   ///< a right click
    std::function<void()> onSettings;                          ///< called when the favourites have changed
    std::function<void()> onLeave;                             ///< called by Esc in the search, which also clears it

    /// Preview a preset with its own gesture while the mouse button is held.
    std::function<void (const std::filesystem::path&)> onPreview;
    std::function<void()> onPreviewEnd;

    void showOpen (const std::filesystem::path&);   ///< marks the preset that is open
    void reload();                                  ///< reads the folders again
    void refresh();                                 ///< call this many times a second

    const std::vector<Preset>& shipped() const noexcept { return presets; }
    void search (const juce::String&);   ///< as if the user had typed the text
    void beginSearch();                  ///< gives the keyboard to the search; what is typed next replaces its text

    /// A row of the list: a heading or a preset. A click on the heading of own graphs shows all of them, or fewer.
    struct Row
    {
        juce::String heading;
        const Preset* preset = nullptr;
        bool is_own = false;
    };
    const std::vector<Row>& rows() const noexcept { return shown; }

    void paint (juce::Graphics&) override;
    void resized() override;
    void mouseMove (const juce::MouseEvent&) override;
    void mouseExit (const juce::MouseEvent&) override;
    void mouseDown (const juce::MouseEvent&) override;
    void mouseDrag (const juce::MouseEvent&) override;
    void mouseUp (const juce::MouseEvent&) override;

private:
    int getNumRows() override { return static_cast<int> (shown.size()); }
    juce::String getNameForRow (int) override;
    juce::String getTooltipForRow (int) override;
    void paintListBoxItem (int row, juce::Graphics&, int w, int h, bool selected) override;
    void listBoxItemClicked (int row, const juce::MouseEvent&) override;
    void returnKeyPressed (int row) override { openRow (row); }
    void selectedRowsChanged (int) override { repaint(); }
    using juce::Component::keyPressed;
    bool keyPressed (const juce::KeyPress&, juce::Component*) override;   // of the search and the list

    void update();
    void fillRows();
    void openRow (int row);
    const Row* rowAt (int) const;
    int presetFrom (int row, int step) const;

    /// The clickable parts of a row.
    enum class Part
    {
        name,
        preview,
        star
    };
    Part partAt (const Row&, int x) const;
    const Preset* described() const;
    void paintFooter (juce::Graphics&, const Preset&);
    void paintIcons (juce::Graphics&, const Row&, bool is_hovered, juce::Rectangle<int>& area) const;

    const Catalogue& catalogue;
    Settings& settings;
    PictureStore& pictures;
    const std::filesystem::path folder, own_folder;
    std::filesystem::path open;
    std::vector<Preset> presets, own;             // all presets in the folders; own ones also from elsewhere, the latest first
    std::vector<Preset> found, found_own, best;   // those that match the search; `best` are both, while words are typed
    bool shows_all_own = false, has_more_own = false;
    std::vector<Row> shown;
    int hovered = -1, pictures_done = 0;
    bool is_previewing = false, was_dragged = false;
    juce::Rectangle<int> footer;
    juce::TextEditor query;
    TagChips chips;
    juce::ListBox list { {}, this };
};

}   // namespace tactus::host
