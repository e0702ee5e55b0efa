// SPDX-License-Identifier: GPL-3.0-or-later
#include "browser.hpp"

namespace tactus::host
{

PresetBrowser::PresetBrowser (std::filesystem::path f) : folder (std::move (f)), all (presetsIn (folder)), found (all)
{
    setTitle ("Presets");
    const auto& look = lookOf (*this);
    query.setFont (look.font (13.0f));
    query.setIndents (8, 4);
    query.setTextToShowWhenEmpty ("Search presets", look.theme().dim);
    query.onTextChange = [this]
    { update(); };
    query.onEscapeKey = [this]
    {
        query.clear();
        update();
    };
    list.setRowHeight (44);
    list.setColour (juce::ListBox::backgroundColourId, juce::Colours::transparentBlack);
    list.getViewport()->setScrollBarThickness (8);
    addAndMakeVisible (query);
    addAndMakeVisible (list);
}

void PresetBrowser::showOpen (const std::filesystem::path& file)
{
    open = file;
    list.repaint();
}

void PresetBrowser::update()
{
    found = matching (all, query.getText().toStdString());
    list.updateContent();
    list.repaint();
    repaint();
}

void PresetBrowser::listBoxItemClicked (int row, const juce::MouseEvent&)
{
    if (row >= 0 && row < getNumRows() && onOpen) onOpen (found[static_cast<std::size_t> (row)]);
}

juce::String PresetBrowser::getTooltipForRow (int row)
{
    if (row < 0 || row >= getNumRows()) return {};
    const auto& p = found[static_cast<std::size_t> (row)];
    return p.problem.empty() ? p.about : p.problem;
}

void PresetBrowser::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    g.fillAll (look.theme().panel);
    g.setColour (look.theme().hairline);
    g.drawVerticalLine (getWidth() - 1, 0.0f, static_cast<float> (getHeight()));
    if (! found.empty()) return;
    g.setColour (look.theme().dim);
    g.setFont (look.font (13.0f));
    const auto text = ! all.empty() ? juce::String ("No preset has these words.") : folder.empty() ? juce::String ("No presets were found beside the program. Set TACTUS_PRESETS to their folder.")
                                                                                                   : "There are no presets in " + juce::String (folder.string()) + ".";
    g.drawFittedText (text, getLocalBounds().reduced (16).withTrimmedTop (40), juce::Justification::topLeft, 6);
}

void PresetBrowser::resized()
{
    auto area = getLocalBounds().withTrimmedRight (1).reduced (8);
    query.setBounds (area.removeFromTop (28));
    area.removeFromTop (8);
    list.setBounds (area);
}

void PresetBrowser::paintListBoxItem (int row, juce::Graphics& g, int w, int h, bool)
{
    if (row < 0 || row >= getNumRows()) return;
    const auto& p = found[static_cast<std::size_t> (row)];
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    auto area = juce::Rectangle<int> (w, h);
    if (p.file == open)
    {
        g.setColour (theme.accent.withAlpha (0.18f));
        g.fillRoundedRectangle (area.toFloat().reduced (1.0f), 4.0f);
    }
    area.reduce (8, 4);
    g.setColour (theme.text);
    g.setFont (look.font (13.0f, true));
    g.drawText (p.name, area.removeFromTop (18), juce::Justification::centredLeft, true);
    g.setFont (look.font (11.5f));
    g.setColour (p.problem.empty() ? theme.dim : theme.warning);
    juce::StringArray tags;
    for (const auto& t : p.tags)
        tags.add (t);
    g.drawText (p.problem.empty() ? tags.joinIntoString (" · ") : juce::String ("cannot be read"), area, juce::Justification::centredLeft, true);
}

}   // namespace tactus::host
