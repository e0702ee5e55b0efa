// SPDX-License-Identifier: GPL-3.0-or-later
// What the window says about the things in it.
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/seen_text.hpp"
#include "host/app/support/window_rig.hpp"

#include <catch2/catch.hpp>

#include <host/app/model/with_prefix.hpp>
#include <map>
#include <set>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::CanvasRig;
using tactus::host::test::readTexts;
using tactus::host::test::WindowRig;

TEST_CASE ("each part of the strip says what it means", "[app][words]")
{
    WindowRig w ("dry_wood.json", 1920, 1080, false);
    for (int i = 0; i < 500 && w.view->run().delay() == std::nullopt; ++i)
        WindowRig::settle (10);
    WindowRig::settle (200);
    SafetyStrip* strip = nullptr;
    for (auto* child : w.view->getChildren())
        if (auto* found = dynamic_cast<SafetyStrip*> (child)) strip = found;
    REQUIRE (strip != nullptr);
    std::map<juce::String, juce::String> meanings;
    for (const auto& t : readTexts (*strip))
        if (const auto meaning = strip->tooltipAt (t.place.getCentre().toInt()); meaning.isNotEmpty()) meanings[t.text] = meaning;
    const auto says = [&] (const juce::String& part, const juce::String& word) {
        for (const auto& [text, meaning] : meanings)
            if (text.startsWith (part) && meaning.contains (word)) return true;
        return false;
    };
    CHECK (says ("running", "ticks per second"));
    CHECK (says ("guard ready", "between the graph and the motors"));
    CHECK (says ("late ticks", "not finished in time"));
    CHECK (says ("delay", "from a movement of the hand"));
    CHECK (says ("walls stable up to", "largest stiffness"));
    CHECK (strip->tooltipAt ({ -5, -5 }).isEmpty());
    w.view->run().letGo();
}

TEST_CASE ("START and STOP say what they do, and which key does it, too", "[app][words]")
{
    WindowRig w ("dry_wood.json");
    const auto tipOf = [&] (const char* text) {
        auto* button = WindowRig::buttonIn (*w.view, text);
        REQUIRE (button != nullptr);
        return button->getTooltip();
    };
    WindowRig::settle (100);
    CHECK (tipOf ("START").contains ("F5"));
    w.key ("F5");
    for (int i = 0; i < 3000 && WindowRig::buttonIn (*w.view, "STOP") == nullptr; ++i)
        WindowRig::settle (10);
    CHECK (tipOf ("STOP").contains ("Esc"));
    w.key ("escape");
    for (int i = 0; i < 3000 && WindowRig::buttonIn (*w.view, "START") == nullptr; ++i)
        WindowRig::settle (10);
    CHECK (tipOf ("START").contains ("F5"));
    w.view->run().letGo();
}

TEST_CASE ("while nothing runs, a port says what it is, also at its label, and while it runs, a card does", "[app][words]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const auto at = rig.port ("drag", Role::output, "force");
    CHECK (rig.canvas->tooltipAt (at) == "drag.force  [N]  force on the tool");
    CHECK (rig.canvas->tooltipAt (at - juce::Point<float> (24.0f * rig.canvas->view().zoom, 0.0f)).startsWith ("drag.force"));
    CHECK (rig.canvas->tooltipAt (rig.nowhere()).isEmpty());
    const auto damping = rig.canvas->tooltipAt (rig.port ("board", Role::param, "damping"));
    CHECK (damping.contains (juce::String::fromUTF8 ("[N\xc2\xb7s/m]")));   // as in the fields
    CHECK (withPrefix (0.3, "N*s/m") == "0.30 N\xc2\xb7s/m");
    LiveState running;
    running.runs = true;
    rig.canvas->showLive (running);
    CHECK (rig.canvas->tooltipAt (at).isEmpty());
}

TEST_CASE ("the lists of the help have aligned columns", "[app][words]")
{
    WindowRig w ("dry_wood.json", 1280, 2400);
    const auto columnOf = [&] (std::initializer_list<const char*> beginnings) {
        std::set<int> found;
        for (const auto* beginning : beginnings)
        {
            INFO (beginning);
            bool is_there = false;
            for (const auto& t : readTexts (w.view->part<HelpPanel>()))
                if (t.text.startsWith (beginning))
                {
                    is_there = true;
                    found.insert (t.place.toNearestInt().getX());
                }
            CHECK (is_there);
        }
        return found;
    };
    w.key ("F1");
    REQUIRE (w.view->part<HelpPanel>().isOpen());
    CHECK (columnOf ({ "emergency stop", "recalls a snapshot", "new, open" }).size() == 1);
    w.view->part<HelpPanel>().showNode ("friction.elasto_plastic");
    CHECK (columnOf ({ "tool position p", "direction out of the surface", "force f_n of the tool" }).size() == 1);
}
