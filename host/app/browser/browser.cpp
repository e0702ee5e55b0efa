// SPDX-License-Identifier: GPL-3.0-or-later
#include "browser.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int row_height = 36, star_width = 28, play_width = 28;
constexpr int low = 420;                               // pixels; a lower panel shows a compact layout
constexpr int two_lines = 44, picture_and_text = 88;   // heights of the description of a preset

juce::String joined (const std::vector<std::string>& tags)
{
    juce::StringArray all;
    for (const auto& t : tags)
        all.add (t);
    return all.joinIntoString (", ");
}

/// The feel of a preset, or the reason why it cannot be opened as it is.
juce::String descriptionOf (const Preset& p)
{
    if (! p.problem.empty()) return p.problem;
    const auto placeholders = placeholderText (p);
    return placeholders.empty() ? juce::String (p.about) : juce::String (placeholders) + ". " + TRANS ("The graph does not run without them.") + " " + p.about;
}
}   // namespace

PresetBrowser::PresetBrowser (const Catalogue& c, Settings& s, PictureStore& p)
    : catalogue (c), settings (s), pictures (p), folder (presetFolder()), own_folder (ownFolder())
{
    setTitle (TRANS ("Presets"));
    const auto& look = lookOf (*this);
    query.setFont (look.font (13.0f));
    query.setIndents (8, 6);
    query.setTitle (TRANS ("Search presets"));
    query.setTextToShowWhenEmpty (TRANS ("Search presets"), look.theme().dim);
    query.onTextChange = [this] { update(); };
    query.onEscapeKey = [this] {
        search ({});
        if (onLeave) onLeave();
    };
    query.onReturnKey = [this] {
        const int selected = list.getSelectedRow();
        openRow (selected >= 0 ? selected : presetFrom (0, 1));
    };
    query.addKeyListener (this);
    chips.onChange = [this] { update(); };
    chips.onResize = [this] { resized(); };
    list.setTitle (TRANS ("Presets"));
    list.setRowHeight (row_height);
    list.setColour (juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    list.getViewport()->setScrollBarThickness (8);
    list.setRowSelectedOnMouseDown (false);   // a press may begin a drag
    list.addMouseListener (this, true);
    list.addKeyListener (this);
    addAndMakeVisible (query);
    addAndMakeVisible (chips);
    addAndMakeVisible (list);
    reload();
}

void PresetBrowser::reload()
{
    presets = presetsIn (folder, catalogue);
    own = presetsIn (own_folder, catalogue);
    // The latest come first, also those from other folders. A preset that was opened as a file is in its own list.
    std::vector<Preset> latest;
    std::error_code failed;
    for (const auto& file : settings.recent)
    {
        const auto isThis = [&] (const Preset& p) { return p.file.filename() == file.filename() && std::filesystem::equivalent (p.file, file, failed); };
        if (std::ranges::any_of (presets, isThis)) continue;
        const auto at = std::ranges::find (own, file, &Preset::file);
        if (at != own.end())
        {
            latest.push_back (std::move (*at));
            own.erase (at);
        }
        else if (std::filesystem::is_regular_file (file, failed))
            latest.push_back (presetOf (file, catalogue));
    }
    own.insert (own.begin(), std::make_move_iterator (latest.begin()), std::make_move_iterator (latest.end()));
    update();
}

/// The first row with a preset, from this one on.
int PresetBrowser::presetFrom (int row, int step) const
{
    while (rowAt (row) != nullptr && rowAt (row)->preset == nullptr)
        row += step;
    return rowAt (row) == nullptr ? -1 : row;
}

/// In the search, the arrow keys choose what Return opens.
bool PresetBrowser::keyPressed (const juce::KeyPress& key, juce::Component* in)
{
    if (key == juce::KeyPress (juce::KeyPress::returnKey, juce::ModifierKeys::ctrlModifier, 0))
    {
        const int selected = list.getSelectedRow();
        const auto* r = rowAt (selected >= 0 ? selected : presetFrom (0, 1));
        if (r != nullptr && r->preset != nullptr && onAdd) onAdd (Preset (*r->preset));
        return true;
    }
    if (in != &query) return false;
    const bool is_down = key == juce::KeyPress::downKey;
    if (! is_down && key != juce::KeyPress::upKey) return false;
    const int step = is_down ? 1 : -1, selected = list.getSelectedRow();
    if (const int to = presetFrom (selected >= 0 ? selected + step : 0, selected >= 0 ? step : 1); to >= 0) list.selectRow (to);
    return true;
}

void PresetBrowser::beginSearch()
{
    takeFocus (query);
    query.selectAll();
}

void PresetBrowser::search (const juce::String& text)
{
    query.setText (text, false);
    update();
}

void PresetBrowser::showOpen (const std::filesystem::path& file)
{
    open = file;
    list.repaint();
    repaint (footer);
}

void PresetBrowser::refresh()
{
    if (pictures_done == pictures.done()) return;
    pictures_done = pictures.done();
    repaint (footer);
}

void PresetBrowser::update()
{
    const auto text = query.getText().toStdString();
    found = matching (presets, text, chips.chosen());
    found_own = matching (own, text, chips.chosen());
    auto all = found;
    all.insert (all.end(), found_own.begin(), found_own.end());
    std::vector<std::string> tags;
    for (const auto& [tag, count] : tagsOf (all))
        tags.push_back (tag);
    for (const auto& tag : chips.chosen())
        if (std::ranges::count (tags, tag) == 0) tags.push_back (tag);
    chips.show (std::move (tags));
    list.setVerticalPosition (0.0);
    resized();
    repaint();
}

/// Fills the list. A typed text is looked for everywhere, and the best comes first. Otherwise, own graphs leave room for presets.
void PresetBrowser::fillRows()
{
    shown.clear();
    if (const auto text = query.getText().toStdString(); ! text.empty())
    {
        best = own;
        best.insert (best.end(), presets.begin(), presets.end());
        best = matching (best, text, chips.chosen());
        for (const auto& p : best)
            shown.push_back ({ {}, &p, std::ranges::count (own, p.file, &Preset::file) > 0 });
    }
    else
    {
        const auto isFavourite = [this] (const Preset& p) { return settings.isFavourite (p.file); };
        const auto add = [this] (const juce::String& heading, bool is_own, std::size_t most, auto&& isWanted) {
            std::vector<const Preset*> wanted;
            for (const auto& p : is_own ? found_own : found)
                if (isWanted (p)) wanted.push_back (&p);
            const auto count = std::min (most, wanted.size());
            if (count > 0)
                shown.push_back ({ count < wanted.size() ? heading + filled (TRANS (": %1 of %2"), count, wanted.size()) : heading, nullptr, is_own });
            for (const auto* p : std::span (wanted).first (count))
                shown.push_back ({ {}, p, is_own });
        };
        const auto room = static_cast<std::size_t> (std::max (1, list.getHeight() / row_height / 2 - 1));   // the other half is for presets
        has_more_own = found_own.size() > room;
        add (TRANS ("My graphs"), true, shows_all_own ? found_own.size() : room, [] (const Preset&) { return true; });
        add (TRANS ("Favourites"), false, found.size(), isFavourite);
        add (TRANS ("Presets"), false, found.size(), [&] (const Preset& p) { return ! isFavourite (p); });
        if (std::ranges::count (shown, nullptr, &Row::preset) == 1) shown.erase (shown.begin());   // a single section needs no heading
    }
    hovered = -1;
    list.deselectAllRows();
    list.updateContent();
    if (! query.isEmpty()) list.selectRow (presetFrom (0, 1));   // what Return opens
    list.repaint();
}

const PresetBrowser::Row* PresetBrowser::rowAt (int row) const
{
    return row < 0 || row >= static_cast<int> (shown.size()) ? nullptr : &shown[static_cast<std::size_t> (row)];
}

juce::String PresetBrowser::getNameForRow (int row)
{
    const auto* r = rowAt (row);
    if (r == nullptr) return {};
    return r->preset != nullptr ? juce::String (r->preset->name) : juce::String (r->heading);
}

/// The description, where there is no room for all of it below the list.
juce::String PresetBrowser::getTooltipForRow (int row)
{
    const auto* r = rowAt (row);
    return r == nullptr || r->preset == nullptr || footer.getHeight() > two_lines ? juce::String() : descriptionOf (*r->preset);
}

void PresetBrowser::openRow (int row)
{
    const auto* r = rowAt (row);
    if (r == nullptr || r->preset == nullptr || ! onOpen) return;
    const auto preset = *r->preset;   // opening may reload the list
    onOpen (preset, r->is_own);
}

void PresetBrowser::listBoxItemClicked (int row, const juce::MouseEvent& e)
{
    const auto* r = rowAt (row);
    if (r == nullptr || was_dragged) return;
    if (e.mods.isPopupMenu() && r->preset != nullptr && onMenu) return onMenu (Preset (*r->preset), r->is_own);
    if (! e.mods.isLeftButtonDown()) return;
    if (r->preset == nullptr)
    {
        if (! r->is_own) return;
        shows_all_own = ! shows_all_own;
        return fillRows();
    }
    const auto part = partAt (*r, e.getEventRelativeTo (&list).x);
    if (part == Part::name) return openRow (row);
    if (part == Part::preview) return;   // handled by mouseDown
    settings.toggleFavourite (r->preset->file);
    if (onSettings) onSettings();
    const auto at = list.getVerticalPosition();
    update();
    list.setVerticalPosition (at);
}

const Preset* PresetBrowser::described() const
{
    for (const int row : { hovered, list.getSelectedRow() })
        if (const auto* r = rowAt (row); r != nullptr && r->preset != nullptr) return r->preset;
    for (const auto* all : { &presets, &own })
        for (const auto& p : *all)
            if (p.file == open) return &p;
    return nullptr;
}

PresetBrowser::Part PresetBrowser::partAt (const Row& row, int x) const
{
    const int from_right = list.getVisibleRowWidth() - x;
    if (from_right < star_width) return row.is_own ? Part::name : Part::star;
    const bool can_play = row.preset != nullptr && row.preset->problem.empty();
    return can_play && from_right < star_width + play_width ? Part::preview : Part::name;
}

void PresetBrowser::mouseDown (const juce::MouseEvent& e)
{
    was_dragged = false;
    if (! e.mods.isLeftButtonDown()) return;
    const auto at = e.getEventRelativeTo (&list).getPosition();
    const auto* r = list.getLocalBounds().contains (at) ? rowAt (list.getRowContainingPosition (at.x, at.y)) : nullptr;
    if (r == nullptr || r->preset == nullptr || partAt (*r, at.x) != Part::preview || ! onPreview) return;
    is_previewing = true;
    onPreview (r->preset->file);
}

/// The list of JUCE would drag the row in a window of its own, which needs a compositor.
void PresetBrowser::mouseDrag (const juce::MouseEvent& e)
{
    auto* container = juce::DragAndDropContainer::findParentDragContainerFor (this);
    if (container == nullptr || container->isDragAndDropActive() || is_previewing || ! e.mods.isLeftButtonDown() || ! e.mouseWasDraggedSinceMouseDown())
        return;
    const auto began = list.getLocalPoint (e.eventComponent, e.getMouseDownPosition());
    const int row = list.getLocalBounds().contains (began) ? list.getRowContainingPosition (began.x, began.y) : -1;
    const auto* r = rowAt (row);
    if (r == nullptr || r->preset == nullptr || ! r->preset->problem.empty()) return;
    was_dragged = true;
    int x = 0, y = 0;
    juce::SparseSet<int> rows;
    rows.addRange ({ row, row + 1 });
    container->startDragging (juce::String (asDragged (*r->preset)), &list, list.createSnapshotOfRows (rows, x, y), false);
}

void PresetBrowser::mouseUp (const juce::MouseEvent&)
{
    if (std::exchange (is_previewing, false) && onPreviewEnd) onPreviewEnd();
}

void PresetBrowser::mouseMove (const juce::MouseEvent& e)
{
    const auto at = e.getEventRelativeTo (&list).getPosition();
    const int row = list.getLocalBounds().contains (at) ? list.getRowContainingPosition (at.x, at.y) : -1;
    if (row == hovered) return;
    list.repaintRow (hovered);
    hovered = row;
    list.repaintRow (hovered);
    repaint (footer);
}

void PresetBrowser::mouseExit (const juce::MouseEvent& e)
{
    if (list.isMouseOver (true)) return mouseMove (e);
    list.repaintRow (hovered);
    hovered = -1;
    repaint (footer);
}

void PresetBrowser::resized()
{
    auto area = getLocalBounds().withTrimmedRight (1).reduced (8);
    const bool is_low = area.getHeight() < low;
    query.setBounds (area.removeFromTop (28));
    area.removeFromTop (8);
    const int wanted = chips.heightFor (area.getWidth(), is_low ? 1 : 3);
    chips.setBounds (area.removeFromTop (std::min (wanted, area.getHeight() / 2)));
    area.removeFromTop (4);
    int below = is_low ? picture_and_text : 176;   // the description of a preset gives way to the list of presets
    const int rows = own.empty() ? 4 : 6;          // with own graphs, there are two headings, too
    if (area.getHeight() - below < rows * row_height) below = area.getHeight() - two_lines < (rows - 1) * row_height ? 0 : two_lines;
    footer = area.removeFromBottom (below);
    area.removeFromBottom (4);
    list.setBounds (area);
    fillRows();
}

void PresetBrowser::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    g.setColour (look.theme().hairline);
    g.drawVerticalLine (getWidth() - 1, 0.0f, static_cast<float> (getHeight()));
    if (shown.empty())
    {
        auto text = filled (TRANS ("No presets in %1."), folder.string());
        if (folder.empty()) text = TRANS ("No preset folder found. Set TACTUS_PRESETS to its path.");
        if (! presets.empty()) text = TRANS ("No match. Remove a word or a tag.");
        const auto area = list.getBounds().reduced (8).toFloat();
        wrapText (text, look.font (13.0f), look.theme().dim, area.getWidth()).draw (g, area);
    }
    if (footer.isEmpty()) return;
    g.setColour (look.theme().hairline);
    g.drawHorizontalLine (footer.getY(), static_cast<float> (footer.getX()), static_cast<float> (footer.getRight()));
    if (const auto* p = described()) return paintFooter (g, *p);
    const auto hint = TRANS ("Point at a preset to read what it feels like. Click to open and run it, drag it onto the canvas to add it to "
                             "the graph, or hold its arrow to preview it.");
    drawFittedText (g, hint, look.font (12.0f), look.theme().dim, footer.withTrimmedTop (8));
}

void PresetBrowser::paintFooter (juce::Graphics& g, const Preset& p)
{
    const auto& look = lookOf (*this);
    auto area = footer.withTrimmedTop (8);
    const bool has_room = area.getHeight() > 120;
    if (p.problem.empty() && footer.getHeight() >= picture_and_text)
    {
        drawPicture (g, look, area.removeFromBottom (has_room ? 56 : 32).toFloat(), pictures.get (p.file).get());
        area.removeFromBottom (4);
    }
    if (has_room)
    {
        g.setColour (look.theme().text);
        g.setFont (look.font (13.0f, true));
        g.drawText (p.name, area.removeFromTop (18), juce::Justification::centredLeft, true);
    }
    const bool is_fine = p.problem.empty() && placeholderText (p).empty();
    drawFittedText (g, descriptionOf (p), look.font (12.0f), is_fine ? look.theme().dim : look.theme().warning, area);
}

void PresetBrowser::paintIcons (juce::Graphics& g, const Row& row, bool is_hovered, juce::Rectangle<int>& area) const
{
    const auto& theme = themeOf (*this);
    const auto& p = *row.preset;
    const auto all = area;
    const bool is_favourite = settings.isFavourite (p.file);
    if (! row.is_own && (is_hovered || is_favourite))
    {
        juce::Path star;
        star.addStar (area.removeFromRight (star_width).toFloat().getCentre(), 5, 3.2f, 7.0f);
        g.setColour (is_favourite ? theme.warning : theme.dim);
        is_favourite ? g.fillPath (star) : g.strokePath (star, juce::PathStrokeType (1.2f));
    }
    if (! is_hovered || ! p.problem.empty()) return;
    area = all.withTrimmedRight (star_width);
    const auto at = area.removeFromRight (play_width).toFloat().getCentre();
    juce::Path play;
    play.addTriangle (at.translated (-4.0f, -6.0f), at.translated (-4.0f, 6.0f), at.translated (6.0f, 0.0f));
    g.setColour (theme.accent);
    g.fillPath (play);
}

void PresetBrowser::paintListBoxItem (int row, juce::Graphics& g, int w, int h, bool selected)
{
    const auto* r = rowAt (row);
    if (r == nullptr) return;
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = juce::Rectangle<int> (w, h);
    if (r->preset == nullptr)
    {
        g.setColour (theme.dim);
        g.setFont (look.font (11.0f, true));
        g.drawText (r->heading, area.reduced (8, 4), juce::Justification::bottomLeft, false);
        if (r->is_own && has_more_own)
        {
            g.setColour (theme.accent);
            g.drawText (shows_all_own ? TRANS ("fewer") : TRANS ("all"), area.reduced (8, 4), juce::Justification::bottomRight, false);
        }
        return;
    }
    const auto& p = *r->preset;
    if (p.file == open || selected || row == hovered)
    {
        g.setColour (p.file == open ? theme.accent.withAlpha (0.18f) : theme.raised);
        g.fillRoundedRectangle (area.toFloat().reduced (1.0f), 4.0f);
    }
    paintIcons (g, *r, row == hovered, area);
    area.reduce (8, 2);
    g.setColour (theme.text);
    g.setFont (look.font (13.0f, true));
    g.drawText (p.name, area.removeFromTop (18), juce::Justification::centredLeft, true);
    g.setFont (look.font (11.0f));
    const auto placeholders = placeholderText (p);
    const bool is_fine = p.problem.empty() && placeholders.empty();
    g.setColour (is_fine ? theme.dim : theme.warning);
    const auto trouble = p.problem.empty() ? juce::String (placeholders) : TRANS ("cannot be read");
    g.drawText (is_fine ? joined (p.tags) : trouble, area, juce::Justification::centredLeft, true);
}

}   // namespace tactus::host
