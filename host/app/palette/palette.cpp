// SPDX-License-Identifier: GPL-3.0-or-later
#include "palette.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/look/glyph.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>

namespace tactus::host
{

namespace
{
constexpr int margin = 8, purpose_height = 20, query_height = 32, gap = 6, entry_height = 40, space_above_title = entry_height / 3, no_match_height = 64;
}

Palette::Palette()
{
    setTitle (TRANS ("Palette"));
    query.setFont (lookOf (*this).font (14.0f));
    query.setIndents (10, 8);
    query.setTitle (TRANS ("Search"));
    list.setTitle (TRANS ("Results"));
    query.addListener (this);
    query.addKeyListener (this);
    list.setRowHeight (entry_height);
    list.setColour (juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    list.setWantsKeyboardFocus (false);
    addAndMakeVisible (query);
    addAndMakeVisible (list);
    setVisible (false);
}

void Palette::open (juce::Point<int> at, std::function<std::vector<PaletteEntry> (const std::string&)> s, const juce::String& p,
                    std::function<void (const std::string&)> c, Finds what)
{
    setTopLeftPosition (at);
    search = std::move (s);
    purpose = p;
    on_chosen = std::move (c);
    finds = what;
    query.setText ({}, false);
    query.setTextToShowWhenEmpty (finds == Finds::nodes ? TRANS ("Search by name, unit or description") : TRANS ("Search by name"), themeOf (*this).dim);
    update();
    setVisible (true);
    toFront (false);
    takeFocus (query);
}

void Palette::close()
{
    if (! isVisible()) return;
    const auto* now = juce::Component::getCurrentlyFocusedComponent();
    const bool is_elsewhere = now != nullptr && now != this && ! isParentOf (now);   // such as the search of the presets, by its key
    setVisible (false);
    const auto* window = getPeer();   // while another program has the keyboard, the canvas must not take it back
    if (auto* parent = getParentComponent(); parent != nullptr && ! is_elsewhere && (window == nullptr || window->isFocused())) takeFocus (*parent);
}

void Palette::update()
{
    found = search (query.getText().toStdString());
    list.updateContent();
    fit();
    showFrom (0);
    selectNear (0, 1);
    list.repaint();
    repaint();
}

void Palette::fit()
{
    const int listed = found.empty() ? no_match_height : entry_height * getNumRows() - spaceAtTop();
    auto area = getBounds().withSize (width, std::min (highest, 2 * margin + purpose_height + query_height + gap + listed));
    if (const auto* parent = getParentComponent())
    {
        // The owner leaves space above for what must not be covered, such as STOP.
        const auto room = parent->getLocalBounds().withTrimmedTop (getProperties()["space above"]).reduced (margin);
        area = area.withHeight (std::min (area.getHeight(), room.getHeight())).constrainedWithin (room);
    }
    setBounds (area);
}

int Palette::spaceAtTop() const { return ! found.empty() && found.front().isTitle() ? space_above_title : 0; }

void Palette::showFrom (int row)
{
    list.scrollToEnsureRowIsOnscreen (row);
    auto& view = *list.getViewport();
    if (row == 0) view.setViewPosition (0, spaceAtTop());
}

void Palette::choose (int row)
{
    if (! isEntry (row)) return;
    const auto type = found[static_cast<std::size_t> (row)].type;
    close();
    if (on_chosen) on_chosen (type);
}

void Palette::textEditorFocusLost (juce::TextEditor&)
{
    if (! hasKeyboardFocus (true)) close();
}

bool Palette::keyPressed (const juce::KeyPress& key, juce::Component*)
{
    const bool is_down = key == juce::KeyPress::downKey;
    if (! is_down && key != juce::KeyPress::upKey) return false;
    const int step = is_down ? 1 : -1;
    selectNear (list.getSelectedRow() + step, step);
    return true;
}

juce::String Palette::getNameForRow (int row)
{
    if (row < 0 || row >= getNumRows()) return {};
    const auto& entry = found[static_cast<std::size_t> (row)];
    return juce::String (entry.isTitle() ? entry.name : entry.type);
}

bool Palette::isEntry (int row) const { return row >= 0 && row < static_cast<int> (found.size()) && ! found[static_cast<std::size_t> (row)].isTitle(); }

void Palette::selectNear (int row, int step)
{
    while (row >= 0 && row < getNumRows() && ! isEntry (row))
        row += step;
    if (! isEntry (row)) return;
    if (row > 0 && ! isEntry (row - 1)) showFrom (row - 1);
    list.selectRow (row);
}

void Palette::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    const auto area = getLocalBounds().toFloat();
    g.setColour (theme.panel);
    g.fillRoundedRectangle (area, 6.0f);
    g.setColour (theme.hairline);
    g.drawRoundedRectangle (area.reduced (0.5f), 6.0f, 1.0f);
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    g.drawText (purpose, getLocalBounds().reduced (12, 8).removeFromTop (16), juce::Justification::centredLeft, true);
    if (! found.empty()) return;
    const auto area_below = getLocalBounds().withTrimmedTop (margin + purpose_height + query_height + gap).reduced (12, 10);
    const auto advice = finds == Finds::nodes ? TRANS ("No match. Try a family such as friction or vibration, or a unit such as N. "
                                                       "G groups nodes into a subgraph.")
                                              : TRANS ("No match. Try fewer letters or another word.");
    g.drawFittedText (advice, area_below, juce::Justification::centredTop, 2, 1.0f);
}

void Palette::resized()
{
    auto area = getLocalBounds().reduced (margin);
    area.removeFromTop (purpose_height);
    query.setBounds (area.removeFromTop (query_height));
    area.removeFromTop (gap);
    list.setBounds (area);
}

void Palette::paintListBoxItem (int row, juce::Graphics& g, int w, int h, bool selected)
{
    if (row < 0 || row >= getNumRows()) return;
    const auto& entry = found[static_cast<std::size_t> (row)];
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = juce::Rectangle<int> (w, h);
    if (entry.isTitle())
    {
        g.setColour (theme.dim);
        g.setFont (look.font (12.0f, true));
        g.drawText (entry.name, area.withTrimmedLeft (10).withTrimmedTop (space_above_title), juce::Justification::centredLeft, true);
        return;
    }
    if (selected)
    {
        g.setColour (theme.accent.withAlpha (0.18f));
        g.fillRoundedRectangle (area.toFloat().reduced (1.0f), 4.0f);
    }
    g.setColour (theme.dim);
    const auto family = entry.type.substr (0, entry.type.find_first_of (".:"));
    g.strokePath (glyphOf (family), juce::PathStrokeType (1.3f), juce::AffineTransform::translation (10.0f, static_cast<float> (h) / 2 - 7.0f));
    area = area.withTrimmedLeft (34).reduced (0, 3);
    auto first = entry.summary.empty() ? area : area.removeFromTop (area.getHeight() / 2);
    const bool has_name = ! entry.name.empty() && entry.name != entry.type;
    const auto title = juce::String::fromUTF8 ((has_name ? entry.name : entry.type).c_str());
    first.removeFromRight (10);
    if (has_name)   // the id, as files have it
    {
        g.setColour (theme.dim);
        g.setFont (look.font (11.0f));
        const auto title_width = static_cast<int> (std::ceil (look.font (13.0f, true).getStringWidthFloat (title)));
        g.drawText (juce::String (entry.type), first.withTrimmedLeft (title_width + 8), juce::Justification::centredRight, true);
    }
    g.setColour (theme.text);
    g.setFont (look.font (13.0f, true));
    g.drawText (title, first, juce::Justification::centredLeft, true);
    g.setFont (look.font (12.0f));
    g.setColour (theme.dim);
    g.drawText (entry.summary, area.withTrimmedRight (10), juce::Justification::centredLeft, true);
}

}   // namespace tactus::host
