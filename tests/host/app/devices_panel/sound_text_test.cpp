// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_stage.hpp"

#include <host/app/devices_panel/devices_panel.hpp>
#include <host/app/devices_panel/sound_text.hpp>
#include <host/devices/audio/card.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::waitFor;

TEST_CASE ("a route is typed as on the command line, and keys that cannot be typed are preserved", "[app][sessions]")
{
    const auto route = Json::parse (R"({ "port": "mix.out", "channel": 3, "full_scale": "4 N", "gain": -1 })");
    CHECK (textOfRoute (route) == "mix.out=3@4 N");
    const auto read = readRouteText ("drag.force.x = 4 @ 2 N", route);
    REQUIRE_FALSE (read);   // a space is not part of a port or channel
    const auto again = readRouteText ("drag.force.x=4@2 N", route);
    REQUIRE (again);
    CHECK (*again == Json::parse (R"({ "port": "drag.force.x", "channel": 4, "full_scale": "2 N", "gain": -1 })"));
    CHECK (*readRouteText ("mix.out=1", Json::object()) == Json::parse (R"({ "port": "mix.out", "channel": 1 })"));
    for (const auto* wrong : { "", "mix.out", "mix.out=", "mix.out=x", "mix.out=0", "mix.out=1@", "mix.out=1@4 apples" })
        CHECK_FALSE (readRouteText (wrong, Json::object()));
}

TEST_CASE ("the channels of a role are typed as a list", "[app][sessions]")
{
    const auto list = Json::parse (R"([ { "channel": 3, "full_scale": "4 N", "high_pass": "20 Hz" }, { "channel": 4, "full_scale": "4 N" } ])");
    CHECK (textOfChannels (list) == "3@4 N, 4@4 N");
    const auto swapped = Json::parse (R"([ { "channel": 4, "full_scale": "2 N" }, { "channel": 3, "full_scale": "5 N", "high_pass": "20 Hz" } ])");
    CHECK (readChannelsText ("4@2 N, 3@5 N", list) == swapped);
    CHECK (readChannelsText ("2", list) == Json::parse (R"([ { "channel": 2 } ])"));
    CHECK (readChannelsText ("left@4 N", {})[0]["channel"] == "left");   // rejected later, when the settings are checked
    CHECK (readChannelsText (" ", list).empty());

    tactus::test::property ("any list reads back as it was typed", [] {
        auto channels = Json::array();
        for (const int channel : *rc::gen::unique<std::vector<int>> (rc::gen::inRange (1, 64)))
        {
            Json use { { "channel", channel } };
            if (*rc::gen::arbitrary<bool>()) use["full_scale"] = std::to_string (*rc::gen::inRange (1, 50)) + " N";
            channels.push_back (use);
        }
        RC_ASSERT (readChannelsText (textOfChannels (channels), {}) == channels);
    });
}

TEST_CASE ("the lists of sound cards say if none was found", "[app][sessions]")
{
    DeskStage w ("dry_wood.json", 1600, 1000);
    w.show<DevicesPanel> (devicesPanel);
    const auto cards = audio::soundCards().list();
    const auto isThere = [&] (auto channels) {
        return std::ranges::any_of (cards, [&] (const audio::ListedCard& c) { return ! (c.*channels).empty() || ! c.trouble.empty(); });
    };
    const auto check = [&] (const char* list, bool has_any) {
        INFO (list);
        const auto* box = dynamic_cast<juce::ComboBox*> (w.titled (list));
        REQUIRE (box != nullptr);
        CHECK (waitFor ([&] { return box->getText() == (has_any ? "automatic" : "automatic (none found)"); }));
    };
    check ("audio system", ! cards.empty());
    check ("output", isThere (&audio::ListedCard::outputs));
    check ("input", isThere (&audio::ListedCard::inputs));
}
