// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/welcome/help_panel.hpp>

#include <set>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::readTexts;

TEST_CASE ("the lists of the help have aligned columns", "[app][words]")
{
    DeskStage w ("dry_wood.json", 1280, 2400);
    HelpPanel help { catalogue() };
    w.stage->addChildComponent (help);
    help.setArea (w.stage->getLocalBounds());
    const auto columnOf = [&] (std::initializer_list<const char*> beginnings) {
        std::set<int> found;
        for (const auto* beginning : beginnings)
        {
            INFO (beginning);
            bool is_there = false;
            for (const auto& t : readTexts (help))
                if (t.text.startsWith (beginning))
                {
                    is_there = true;
                    found.insert (t.place.toNearestInt().getX());
                }
            CHECK (is_there);
        }
        return found;
    };
    help.showKeys();
    REQUIRE (help.isOpen());
    CHECK (columnOf ({ "emergency stop", "recalls a snapshot", "new, open" }).size() == 1);
    help.showNode ("friction.elasto_plastic");
    CHECK (columnOf ({ "tool position p", "direction out of the surface", "force f_n of the tool" }).size() == 1);
}

TEST_CASE ("the list of keys scrolls by keys", "[app][keys]")
{
    DeskStage w ("dry_wood.json");
    HelpPanel help { catalogue() };
    w.stage->addChildComponent (help);
    help.setArea (w.stage->getLocalBounds());
    help.showKeys();
    const auto top = [&] {
        for (const auto& t : readTexts (help))
            if (t.text == "Keyboard shortcuts") return t.place.getY();
        return -1e4f;   // scrolled out of sight
    };
    const auto first = top();
    REQUIRE (first >= 0.0f);
    const auto press = [&] (int key) {
        CHECK (help.keyPressed (juce::KeyPress (key)));
        DeskStage::settle();   // a scroll bar tells its view later
        return top();
    };
    CHECK (press (juce::KeyPress::pageDownKey) < first);
    CHECK (press (juce::KeyPress::homeKey) == first);
    CHECK (press (juce::KeyPress::downKey) < first);
    CHECK_FALSE (help.keyPressed (juce::KeyPress ('x')));
}
