// SPDX-License-Identifier: GPL-3.0-or-later
#include "tabs.hpp"

#include <host/app/look/focus.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr float tab_margin = 4.0f, menu_width = 28.0f;
}   // namespace

juce::Component& Tabs::add (const juce::String& name, std::unique_ptr<juce::Component> panel)
{
    auto& added = *panel;
    addChildComponent (added);
    tabs.push_back ({ name, std::move (panel) });
    show (current);
    resized();
    return added;
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
    const bool is_new = std::exchange (current, index) != index;
    setTitle (filled (TRANS ("Tab: %1"), tabs[static_cast<std::size_t> (index)].name));
    for (std::size_t i = 0; i < tabs.size(); ++i)
    {
        const bool is_shown = static_cast<int> (i) == current;
        if (! is_shown) letGoOfFocus (*tabs[i].panel);
        tabs[i].panel->setVisible (is_shown);
    }
    repaint();
    if (is_new && onShow) onShow();
}

void Tabs::show (const juce::Component& panel)
{
    for (std::size_t i = 0; i < tabs.size(); ++i)
        if (tabs[i].panel.get() == &panel) show (static_cast<int> (i));
}

std::vector<std::pair<juce::String, juce::Rectangle<float>>> Tabs::titles() const
{
    constexpr float wide = 24.0f, narrow = 10.0f;   // the space in a title
    const auto font = lookOf (*this).font (13.0f, true);
    std::vector<float> texts;
    float all_texts = 0.0f;
    for (const auto& t : tabs)
        all_texts += texts.emplace_back (font.getStringWidthFloat (t.name));
    const auto count = static_cast<float> (tabs.size());
    const float whole = static_cast<float> (getWidth()) - tab_margin;
    const bool has_room = all_texts + count * wide <= whole, has_menu = all_texts + count * narrow > whole;
    const float space = has_room ? wide : narrow;
    float left = has_menu ? whole - menu_width : whole;   // for the titles; the current one is always there
    if (current < static_cast<int> (tabs.size())) left -= texts[static_cast<std::size_t> (current)] + space;
    std::vector<std::pair<juce::String, juce::Rectangle<float>>> all;
    float x = tab_margin;
    for (std::size_t i = 0; i < tabs.size(); ++i)
    {
        const bool is_current = static_cast<int> (i) == current;
        const float width = texts[i] + space;
        const bool is_seen = is_current || width <= left;
        if (! is_current) left = is_seen ? left - width : 0.0f;   // those after it are in the menu, too
        all.emplace_back (tabs[i].name, is_seen ? juce::Rectangle<float> (x, 0.0f, width, static_cast<float> (row_height)) : juce::Rectangle<float>());
        if (is_seen) x += width;
    }
    return all;
}

juce::Rectangle<float> Tabs::placeOfMenu() const
{
    const auto all = titles();
    const bool is_needed = std::ranges::any_of (all, [] (const auto& t) { return t.second.isEmpty(); });
    return is_needed ? juce::Rectangle<float> (static_cast<float> (getWidth()) - menu_width, 0.0f, menu_width, static_cast<float> (row_height))
                     : juce::Rectangle<float>();
}

/// The tabs that there is no room for.
void Tabs::openMenu()
{
    juce::PopupMenu menu;
    const auto all = titles();
    for (std::size_t i = 0; i < all.size(); ++i)
        if (all[i].second.isEmpty())
            menu.addItem (all[i].first, [safe = juce::Component::SafePointer (this), i] {
                if (safe != nullptr) safe->show (static_cast<int> (i));
            });
    menu.showMenuAsync (juce::PopupMenu::Options().withTargetComponent (*this).withTargetScreenArea (localAreaToGlobal (placeOfMenu().toNearestInt())));
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
        if (place.isEmpty()) continue;
        const bool is_current = static_cast<int> (i) == current;
        const auto colour = is_current ? theme.text : theme.dim;
        g.setFont (look.font (13.0f, true));
        g.setColour (tabs[i].alarms ? theme.stop : colour);
        g.drawText (name, place, juce::Justification::centred, false);
        if (! is_current) continue;
        g.setColour (theme.accent);
        g.fillRect (place.withSizeKeepingCentre (g.getCurrentFont().getStringWidthFloat (name), place.getHeight()).removeFromBottom (2.0f));
        if (hasKeyboardFocus (false)) g.drawRoundedRectangle (place.reduced (4.0f), 4.0f, 1.0f);
    }
    const auto more = placeOfMenu();
    if (more.isEmpty()) return;
    bool alarms = false;
    for (std::size_t i = 0; i < tabs.size(); ++i)
        alarms = alarms || (tabs[i].alarms && all[i].second.isEmpty());
    g.setColour (alarms ? theme.stop : theme.dim);
    for (const float x : { -6.0f, 0.0f, 6.0f })
        g.fillEllipse (juce::Rectangle<float> (3.0f, 3.0f).withCentre (more.getCentre().translated (x, 0.0f)));
}

void Tabs::resized()
{
    for (auto& t : tabs)
        t.panel->setBounds (getLocalBounds().withTrimmedTop (row_height));
}

void Tabs::mouseDown (const juce::MouseEvent& e)
{
    if (placeOfMenu().contains (e.position)) return openMenu();
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
