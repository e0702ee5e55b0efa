// SPDX-License-Identifier: GPL-3.0-or-later
// Quit, and what the search for commands says about remote control.
#include "host/app/support/window_rig.hpp"

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

TEST_CASE ("Quit is in the menu, on a key, and in the search for commands", "[app][keyboard]")
{
    WindowRig w ("dry_wood.json");
    int quits = 0;
    w.view->allowQuit ([&] { ++quits; });
    w.key ("ctrl + q");
    CHECK (quits == 1);
    w.choose (w.middleOf (*w.titled ("Menu")), -1, juce::ModifierKeys::leftButtonModifier);   // the last entry
    CHECK (quits == 2);
    w.key ("ctrl + k");
    w.stage->type ("quit");
    w.key ("return");
    WindowRig::settle();
    CHECK (quits == 3);
}

TEST_CASE ("the search for commands finds OSC, and says at which port messages arrive", "[app][keyboard][osc]")
{
    WindowRig w ("dry_wood.json");
    const auto told = [&] {
        w.key ("ctrl + k");
        w.stage->type ("osc");
        w.key ("return");
        WindowRig::settle();
        REQUIRE (w.view->asked().isOpen());
        CHECK (w.view->asked().title().contains ("OSC"));
        const auto text = w.view->asked().getDescription();
        w.key ("escape");
        return text;
    };
    CHECK (told().startsWith ("No OSC messages"));
    MainView::StartOptions start { .home = w.home.path(), .safe = true };
    start.osc = OscListen { .port = 0 };
    w.view = std::make_unique<MainView> (catalogue());
    w.stage->fill (*w.view);
    w.view->begin (start);
    WindowRig::settle();
    CHECK (told().contains ("UDP port "));
    CHECK_FALSE (told().contains ("UDP port 0"));
}
