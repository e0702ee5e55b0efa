// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

TEST_CASE ("the snapshots have a caption, which never covers the name of the graph")
{
    for (const int width : { 800, 960, 1024, 1280, 1920 })
        for (const auto* name : { "Dry wood", "A very long name of a graph that fills the bar up to the buttons on its right" })
        {
            WindowRig rig ("dry_wood.json", width, 700);
            REQUIRE (rig.view->document().perform (graph::SetHeader { .name = name }));
            WindowRig::settle();
            const auto texts = tactus::host::test::readTexts (*rig.view);
            const auto bar = juce::Rectangle<int> (0, SafetyStrip::height, width, TopBar::height).toFloat();
            INFO (width << ": " << name);
            CHECK (std::ranges::any_of (texts, [&] (const auto& t) { return t.text == "Snapshots" && bar.contains (t.place); }));
            CHECK (tactus::host::test::overlaps (texts, bar).isEmpty());
        }
}

TEST_CASE ("the snapshot whose values the graph has is lit", "[app][snapshots]")
{
    WindowRig w ("dry_wood.json");
    const auto lit = [&] {
        WindowRig::settle();
        std::string numbers;
        for (int n = 1; n <= snapshot_count; ++n)
            if (const auto* slot = dynamic_cast<juce::Button*> (w.titled ("Snapshot " + juce::String (n))); slot != nullptr && slot->getToggleState())
                numbers += std::to_string (n);
        return numbers;
    };
    CHECK (lit().empty());
    w.key ("ctrl + 1");
    CHECK (lit() == "1");
    REQUIRE (w.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    CHECK (lit().empty());
    w.key ("ctrl + 2");
    CHECK (lit() == "2");
    w.key ("1");
    CHECK (lit() == "1");
    const auto colour = [&] (int n) {
        auto* slot = w.titled ("Snapshot " + juce::String (n));
        return slot->createComponentSnapshot (slot->getLocalBounds()).getPixelAt (6, slot->getHeight() / 2);
    };
    CHECK (colour (1) == themeOf (*w.view).accent);
    CHECK (colour (2) != colour (1));
    CHECK (colour (2) != colour (3));
    auto turned = w.graph().controls[0];
    turned.value = 0.25;
    REQUIRE (w.view->document().perform (graph::ChangeControl { turned.id, turned }));
    CHECK (lit().empty());
    w.key ("ctrl + z");
    CHECK (lit() == "1");
}

TEST_CASE ("a right click on a snapshot moves no value, and offers to recall, to overwrite and to clear it", "[app][snapshots]")
{
    WindowRig w ("dry_wood.json");
    const auto middle = [&] { return w.middleOf (*w.titled ("Snapshot 1")); };
    const auto mu = [&] { return w.graph().root.find ("drag")->params["mu"]; };
    w.choose (middle(), 1);   // the only entry of an empty one
    REQUIRE (hasSnapshot (w.graph(), 1));
    REQUIRE (w.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.9) }));
    w.choose (middle(), 1, juce::ModifierKeys::rightButtonModifier, "escape");
    CHECK (mu() == 0.9);
    w.choose (middle(), 2);
    CHECK (isAtSnapshot (w.graph(), 1));
    REQUIRE (w.view->document().perform (graph::SetParam { "", "drag", "mu", Json (0.4) }));
    w.choose (middle(), 1);
    CHECK (mu() == 0.9);
    w.choose (middle(), 3);
    CHECK_FALSE (hasSnapshot (w.graph(), 1));
    w.key ("ctrl + z");
    CHECK (hasSnapshot (w.graph(), 1));
}
