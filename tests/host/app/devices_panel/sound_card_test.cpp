// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_rig.hpp"

#include <host/app/devices_panel/devices_panel.hpp>
#include <host/devices/audio/card.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskRig;

namespace
{
juce::Component* titledIn (juce::Component& c, const juce::String& title)
{
    if (c.getTitle() == title) return &c;
    for (auto* child : c.getChildren())
        if (auto* found = titledIn (*child, title)) return found;
    return nullptr;
}
}   // namespace

TEST_CASE ("the lists of sound cards say if none was found", "[app][sessions]")
{
    DeskRig r ("dry_wood.json");
    auto& panel = r.make<DevicesPanel> (devicesPanel);
    panel.setVisible (true);
    r.refresh();
    const auto cards = audio::soundCards().list();
    const auto isThere = [&] (auto channels) {
        return std::ranges::any_of (cards, [&] (const audio::ListedCard& c) { return ! (c.*channels).empty() || ! c.trouble.empty(); });
    };
    const auto check = [&] (const char* list, bool has_any) {
        INFO (list);
        const auto* box = dynamic_cast<juce::ComboBox*> (titledIn (panel, list));
        REQUIRE (box != nullptr);
        CHECK (box->getText() == (has_any ? "automatic" : "automatic (none found)"));
    };
    check ("audio system", ! cards.empty());
    check ("output", isThere (&audio::ListedCard::outputs));
    check ("input", isThere (&audio::ListedCard::inputs));
}
