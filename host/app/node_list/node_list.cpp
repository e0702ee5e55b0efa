// SPDX-License-Identifier: GPL-3.0-or-later
#include "node_list.hpp"

#include <host/app/look/glyph.hpp>
#include <host/app/look/look.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

namespace
{
constexpr int node_row_height = 26;
}   // namespace

NodeList::NodeList()
{
    setTitle (TRANS ("Nodes"));
    const auto& look = lookOf (*this);
    query.setFont (look.font (13.0f));
    query.setIndents (8, 6);
    query.setTitle (TRANS ("Search nodes"));
    query.setTextToShowWhenEmpty (TRANS ("Search nodes"), look.theme().dim);
    query.onTextChange = [this] { update(); };
    query.onReturnKey = [this] {
        for (int i = 0; i < getNumRows(); ++i)
            if (entryAt (i) != nullptr) return add (i);
    };
    query.onEscapeKey = [this] {
        query.setText ({}, false);
        update();
        if (onLeave) onLeave();
    };
    list.setTitle (TRANS ("Nodes"));
    list.setRowHeight (node_row_height);
    list.setColour (juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    list.getViewport()->setScrollBarThickness (8);
    list.addMouseListener (this, true);
    addAndMakeVisible (query);
    addAndMakeVisible (list);
}

void NodeList::refresh()
{
    is_stale = true;
    if (isVisible()) update();
}

void NodeList::visibilityChanged()
{
    if (isVisible() && is_stale) update();
}

void NodeList::update()
{
    if (! onSearch) return;
    is_stale = false;
    found = onSearch (query.getText().toStdString());
    list.updateContent();
    list.repaint();
}

const PaletteEntry* NodeList::entryAt (int row) const
{
    const bool is_there = row >= 0 && row < static_cast<int> (found.size()) && ! found[static_cast<std::size_t> (row)].isTitle();
    return is_there ? &found[static_cast<std::size_t> (row)] : nullptr;
}

void NodeList::add (int row)
{
    if (const auto* entry = entryAt (row); entry != nullptr && onAdd) onAdd (std::string (entry->type));   // a copy: adding searches again
}

/// The list of JUCE would drag the row in a window of its own, which needs a compositor.
void NodeList::mouseDrag (const juce::MouseEvent& e)
{
    auto* container = juce::DragAndDropContainer::findParentDragContainerFor (this);
    if (container == nullptr || container->isDragAndDropActive() || ! e.mouseWasDraggedSinceMouseDown()) return;
    const auto began = list.getLocalPoint (e.eventComponent, e.getMouseDownPosition());
    const int row = list.getRowContainingPosition (began.x, began.y);
    const auto* entry = entryAt (row);
    if (entry == nullptr) return;
    int x = 0, y = 0;
    juce::SparseSet<int> rows;
    rows.addRange ({ row, row + 1 });
    container->startDragging (juce::String (asDragged (*entry)), &list, list.createSnapshotOfRows (rows, x, y), false);
}

juce::String NodeList::getNameForRow (int row)
{
    return row >= 0 && row < getNumRows() ? juce::String (found[static_cast<std::size_t> (row)].name) : juce::String();
}

juce::String NodeList::getTooltipForRow (int row)
{
    const auto* entry = entryAt (row);
    if (entry == nullptr) return {};
    return filled (TRANS ("%1: %2 Drag it to the canvas, or double-click."), entry->type, juce::String::fromUTF8 (entry->summary.c_str()));
}

void NodeList::paint (juce::Graphics& g)
{
    const auto& theme = themeOf (*this);
    g.fillAll (theme.panel);
    g.setColour (theme.hairline);
    g.drawVerticalLine (getWidth() - 1, 0.0f, static_cast<float> (getHeight()));
}

void NodeList::resized()
{
    auto area = getLocalBounds().withTrimmedRight (1).reduced (8);
    query.setBounds (area.removeFromTop (28));
    list.setBounds (area.withTrimmedTop (8));
}

void NodeList::paintListBoxItem (int row, juce::Graphics& g, int w, int h, bool selected)
{
    if (row < 0 || row >= getNumRows()) return;
    const auto& entry = found[static_cast<std::size_t> (row)];
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = juce::Rectangle<int> (w, h);
    if (selected && ! entry.isTitle())
    {
        g.setColour (theme.accent.withAlpha (0.18f));
        g.fillRoundedRectangle (area.toFloat().reduced (1.0f), 4.0f);
    }
    g.setColour (entry.isTitle() ? theme.dim : theme.text);
    g.setFont (look.font (entry.isTitle() ? 12.0f : 13.0f, entry.isTitle()));
    g.drawText (juce::String::fromUTF8 (entry.name.c_str()), area.withTrimmedLeft (entry.isTitle() ? 6 : 28).withTrimmedRight (4),
                juce::Justification::centredLeft, true);
    if (entry.isTitle()) return;
    g.setColour (theme.dim);
    const auto family = entry.type.substr (0, entry.type.find_first_of (".:"));
    g.strokePath (glyphOf (family), juce::PathStrokeType (1.3f), juce::AffineTransform::translation (8.0f, static_cast<float> (h) / 2 - 7.0f));
}

}   // namespace tactus::host
