// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/window_rig.hpp"

#include <host/devices/audio/card.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

TEST_CASE ("the lists of sound cards say if none was found", "[app][sessions]")
{
    WindowRig w ("dry_wood.json", 1600, 1000);
    w.click ("Devices");
    const auto cards = audio::soundCards().list();
    const auto isThere = [&] (auto channels) {
        return std::ranges::any_of (cards, [&] (const audio::ListedCard& c) { return ! (c.*channels).empty() || ! c.trouble.empty(); });
    };
    const auto check = [&] (const char* list, bool has_any) {
        INFO (list);
        const auto* box = dynamic_cast<juce::ComboBox*> (w.titled (list));
        REQUIRE (box != nullptr);
        CHECK (box->getText() == (has_any ? "automatic" : "automatic (none found)"));
    };
    check ("audio system", ! cards.empty());
    check ("output", isThere (&audio::ListedCard::outputs));
    check ("input", isThere (&audio::ListedCard::inputs));
}
