// SPDX-License-Identifier: GPL-3.0-or-later
#include "devices_panel.hpp"

#include <host/app/look/fitted_text.hpp>
#include <host/app/model/message_text.hpp>
#include <host/app/text/filled.hpp>

#include <algorithm>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int card_width = 280, widest_card = 480, refreshes_apart = 6;   // every sixth refresh updates the panel: five times a second
}   // namespace

DevicesPanel::DevicesPanel (Document& d, LiveRun& r, DeviceSetup& s) : setup (s), edited (d, r, s), made (edited, r, s)
{
    setTitle (TRANS ("Devices"));
    edited.onUpdate = [this] { show(); };
    edited.onSoundCards = [this] {
        if (! columns.empty()) rebuild();
    };
    made.onTry = [this] (const std::string& role) { tryDevice (role); };
    scroll.setViewedComponent (&sheet, false);
    scroll.setScrollBarsShown (true, false);
    scroll.setScrollBarThickness (8);
    scroll.setWantsKeyboardFocus (false);   // the keys are for the fields
    addAndMakeVisible (scroll);
}

DevicesPanel::~DevicesPanel() { setup.scan (false); }

void DevicesPanel::refresh()
{
    if (isVisible() && ++refreshes % refreshes_apart == 0) edited.update();
}

void DevicesPanel::show()
{
    if (columns.empty() || edited.shape() != shown)
    {
        shown = edited.shape();
        rebuild();
    }
    for (auto& c : columns)
        c->refresh (nullptr);
}

void DevicesPanel::rebuild()
{
    // A row may rebuild the card that contains it, and a list of a card that is already gone may still answer: so they are deleted in a later message.
    const auto retired = std::make_shared<std::vector<std::unique_ptr<Column>>> (std::move (columns));
    columns.clear();
    for (auto& c : *retired)
        sheet.removeChildComponent (c.get());
    juce::MessageManager::callAsync ([retired] {});
    columns.push_back (made.clock());
    for (std::size_t i = 0; i < shown.roles.size(); ++i)
        columns.push_back (made.role (i));
    columns.push_back (made.sound());
    for (auto& c : columns)
    {
        c->onHeight = [this] { resized(); };
        sheet.addAndMakeVisible (*c);
        c->refresh (nullptr);
    }
    resized();
}

void DevicesPanel::tryDevice (const std::string& role)
{
    if (! onTry) return;
    const auto tried = onTry (role);
    if (! edited.onHint) return;
    edited.onHint (tried ? filled (TRANS ("Testing %1: a gentle pulse, at most a tenth of the limit of its guard."), role)
                         : fromUtf8 (messageText (tried.error())));
}

void DevicesPanel::paint (juce::Graphics& g) { g.fillAll (lookOf (*this).theme().panel); }

/// Lays out the cards in rows, as many side by side as there is room for.
void DevicesPanel::resized()
{
    scroll.setBounds (getLocalBounds());
    const int width = getWidth() - scroll.getScrollBarThickness();
    const int across = std::clamp (width / card_width, 1, std::max (1, static_cast<int> (columns.size())));
    int x = 0, y = 0, highest = 0;
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
        if (i > 0 && static_cast<int> (i) % across == 0)
        {
            y += highest;
            x = highest = 0;
        }
        columns[i]->layOut (std::min (width / across, widest_card));
        columns[i]->setTopLeftPosition (x, y);
        x += columns[i]->getWidth();
        highest = std::max (highest, columns[i]->getHeight());
    }
    sheet.setSize (width, y + highest);
}

void DevicesPanel::visibilityChanged()
{
    setup.scan (isVisible());
    if (isShowing() && ! edited.hasListed()) edited.listSoundCards();
    if (isVisible()) edited.update();
}

}   // namespace tactus::host
