// SPDX-License-Identifier: GPL-3.0-or-later
#include "tabs.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

namespace tactus::host
{

void Tabs::insert (const juce::String& name, std::unique_ptr<juce::Component> panel)
{
    addChildComponent (*panel);
    tabs.push_back ({ name, std::move (panel) });
    show (current);
    resized();
}

void Tabs::rename (const juce::Component& panel, const juce::String& name, bool alarms)
{
    for (auto& t : tabs)
        if (t.panel.get() == &panel && (t.name != name || t.alarms != alarms))
        {
            t.name = name;
            t.alarms = alarms;
            repaint();
        }
}

void Tabs::show (int index)
{
    if (index < 0 || index >= static_cast<int> (tabs.size())) return;
    current = index;
    setTitle (filled (TRANS ("Tab: %1"), tabs[static_cast<std::size_t> (index)].name));
    for (std::size_t i = 0; i < tabs.size(); ++i)
    {
        const bool is_shown = static_cast<int> (i) == current;
        if (! is_shown) letGoOfFocus (*tabs[i].panel);
        tabs[i].panel->setVisible (is_shown);
    }
    repaint();
}

void Tabs::show (const juce::Component& panel)
{
    for (std::size_t i = 0; i < tabs.size(); ++i)
        if (tabs[i].panel.get() == &panel) show (static_cast<int> (i));
}

std::vector<std::pair<juce::String, juce::Rectangle<float>>> Tabs::titles() const
{
    std::vector<std::pair<juce::String, juce::Rectangle<float>>> all;
    float x = 4.0f;
    for (const auto& t : tabs)
    {
        const float width = lookOf (*this).font (13.0f, true).getStringWidthFloat (t.name) + 24.0f;
        all.emplace_back (t.name, juce::Rectangle<float> (x, 0.0f, width, static_cast<float> (row_height)));
        x += width;
    }
    return all;
}

void Tabs::paint (juce::Graphics& g)
{
    const auto& look = lookOf (*this);
    const auto& theme = look.theme();
    g.fillAll (theme.panel);
    g.setColour (theme.hairline);
    g.drawHorizontalLine (row_height - 1, 0.0f, static_cast<float> (getWidth()));
    const auto all = titles();
    for (std::size_t i = 0; i < tabs.size(); ++i)
    {
        const auto& [name, place] = all[i];
        const bool is_current = static_cast<int> (i) == current;
        const auto colour = is_current ? theme.text : theme.dim;
        g.setFont (look.font (13.0f, true));
        g.setColour (tabs[i].alarms ? theme.stop : colour);
        g.drawText (name, place, juce::Justification::centred, false);
        if (! is_current) continue;
        g.setColour (theme.accent);
        g.fillRect (place.reduced (12.0f, 0.0f).removeFromBottom (2.0f));
        if (hasKeyboardFocus (false)) g.drawRoundedRectangle (place.reduced (4.0f), 4.0f, 1.0f);
    }
}

void Tabs::resized()
{
    for (auto& t : tabs)
        t.panel->setBounds (getLocalBounds().withTrimmedTop (row_height));
}

void Tabs::mouseDown (const juce::MouseEvent& e)
{
    const auto all = titles();
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].second.contains (e.position)) show (static_cast<int> (i));
}

bool Tabs::keyPressed (const juce::KeyPress& key)
{
    if (! hasKeyboardFocus (false) || (key != juce::KeyPress::leftKey && key != juce::KeyPress::rightKey)) return false;
    const int count = static_cast<int> (tabs.size());
    show ((current + (key == juce::KeyPress::rightKey ? 1 : count - 1)) % count);
    return true;
}

}   // namespace tactus::host
