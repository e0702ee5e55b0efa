// SPDX-License-Identifier: GPL-3.0-or-later
#include "history_panel.hpp"

#include <host/app/text/filled.hpp>

namespace tactus::host
{

HistoryPanel::HistoryPanel (Document& d) : document (d)
{
    setTitle (TRANS ("History"));
    list.setTitle (TRANS ("History"));
    list.setRowHeight (28);
    list.setColour (juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    list.getViewport()->setScrollBarThickness (8);
    addAndMakeVisible (list);
    document.add (*this);
    documentChanged();
}

HistoryPanel::~HistoryPanel() { document.remove (*this); }

void HistoryPanel::documentChanged()
{
    list.updateContent();
    list.scrollToEnsureRowIsOnscreen (static_cast<int> (document.history().position()));
    list.repaint();
    repaint();
}

void HistoryPanel::goToRow (int row)
{
    if (row >= 0 && row < getNumRows()) document.goTo (static_cast<std::size_t> (row));
}

juce::String HistoryPanel::nameOfRow (int row) const
{
    if (row <= 0 || row > static_cast<int> (document.history().size())) return TRANS ("initial state");
    return juce::String (document.stepName (static_cast<std::size_t> (row) - 1));
}

juce::String HistoryPanel::getTooltipForRow (int row) { return nameOfRow (row); }

void HistoryPanel::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    g.setColour (look.theme().hairline);
    g.drawVerticalLine (getWidth() - 1, 0.0f, static_cast<float> (getHeight()));
    if (getNumRows() > 1) return;
    g.setColour (look.theme().dim);
    g.setFont (look.font (13.0f));
    const auto hint = TRANS ("Your edits are listed here. Click a step to undo or redo up to it; Ctrl+Z and Ctrl+Y go one step at a time.");
    g.drawFittedText (hint, getLocalBounds().reduced (16).withTrimmedTop (32), juce::Justification::topLeft, 8, 1.0f);
}

void HistoryPanel::resized() { list.setBounds (getLocalBounds().withTrimmedRight (1).reduced (8)); }

void HistoryPanel::paintListBoxItem (int row, juce::Graphics& g, int w, int h, bool)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    const auto now = static_cast<int> (document.history().position());
    auto area = juce::Rectangle<int> (w, h);
    if (row == now)
    {
        g.setColour (theme.accent.withAlpha (0.18f));
        g.fillRoundedRectangle (area.toFloat().reduced (1.0f), 4.0f);
        g.setColour (theme.accent);
        g.fillEllipse (juce::Rectangle<float> (6.0f, 6.0f).withCentre ({ 12.0f, static_cast<float> (h) / 2 }));
    }
    g.setColour (row > now ? theme.dim : theme.text);
    g.setFont (look.font (13.0f, row == now));
    // If there is no room for all of it, the new value is what must be seen.
    const auto place = area.withTrimmedLeft (24).withTrimmedRight (4);
    const auto font = g.getCurrentFont();
    const auto text = nameOfRow (row), end = text.fromLastOccurrenceOf (" -> ", true, false);
    const auto room = place.toFloat().getWidth(), end_width = font.getStringWidthFloat (end) + 1.0f;
    if (end.isEmpty() || font.getStringWidthFloat (text) <= room || end_width > 0.7f * room)
        return g.drawText (text, place, juce::Justification::centredLeft, true);
    auto begin = text.dropLastCharacters (end.length());
    while (begin.isNotEmpty() && font.getStringWidthFloat (begin + "...") + end_width > room)
        begin = begin.dropLastCharacters (1);
    g.drawText (begin + "..." + end, place, juce::Justification::centredLeft, true);
}

}   // namespace tactus::host
