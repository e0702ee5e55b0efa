// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

TEST_CASE ("the snapshots have a caption, which never covers the name of the graph")
{
    for (const int width : { 960, 1024, 1280, 1920 })
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
