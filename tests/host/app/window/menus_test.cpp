// SPDX-License-Identifier: GPL-3.0-or-later
// Menus and the palette over a graph that runs: Esc stops first, and STOP stays within reach. Quit, and what the search for commands says of remote control.
#include "host/app/support/window_rig.hpp"

#include "support/waiting.hpp"

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

namespace
{
/// Opens a menu by a click, calls f with it, and closes it.
template <typename F>
void withMenu (WindowRig& w, juce::Component& at, int button, F f)
{
    bool was_open = false;
    int waits = 0;
    // In a message, because JUCE closes a menu at its first timer call if no window of the program has the keyboard of the X server.
    const std::function<void()> look = [&] {
        auto* menu = juce::Component::getCurrentlyModalComponent();
        if (menu == nullptr && ++waits < 1000) return void (juce::MessageManager::callAsync (look));
        waits = 1000;
        if (menu == nullptr) return;
        was_open = true;
        f (*menu);
        juce::PopupMenu::dismissAllActiveMenus();
    };
    w.stage->click (w.middleOf (at), button);
    look();
    while (waits < 1000 || juce::Component::getNumCurrentlyModalComponents() > 0)
        WindowRig::settle();
    REQUIRE (was_open);
}

bool runs (WindowRig& w)
{
    return tactus::test::eventually ({}, [&] {
        WindowRig::settle (5);
        return w.view->run().isRunning();
    });
}
}   // namespace

TEST_CASE ("with the palette open, Esc stops the run first, and then closes the palette", "[app][keys][safety]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    REQUIRE (runs (w));
    REQUIRE_FALSE (w.view->run().drivesDevice());
    w.view->canvas().grabKeyboardFocus();
    w.key ("ctrl + k");
    auto* palette = w.titled ("Palette");
    REQUIRE (palette != nullptr);
    w.key ("escape");
    CHECK_FALSE (w.view->run().isWanted());
    CHECK (palette->isVisible());
    w.key ("escape");
    CHECK_FALSE (palette->isVisible());
}

TEST_CASE ("with a menu open, Esc stops the run first, and then closes the menu", "[app][keys][safety]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    REQUIRE (runs (w));
    withMenu (w, *w.titled ("Menu"), juce::ModifierKeys::leftButtonModifier, [&] (juce::Component& menu) {
        w.stage->key ("escape");
        CHECK_FALSE (w.view->run().isWanted());
        CHECK (juce::Component::getCurrentlyModalComponent() == &menu);
        w.stage->key ("escape");
    });
}

TEST_CASE ("no menu covers STOP, however low the window is", "[app][keys][safety]")
{
    const auto [width, height] = GENERATE (table<int, int> ({ { 1280, 720 }, { 1024, 420 }, { 512, 350 } }));
    INFO (width << " x " << height);
    WindowRig w ("dry_wood.json", width, height);
    const auto isClear = [&] (juce::Component& menu) {
        CHECK (w.view->getLocalArea (&menu, menu.getLocalBounds()).getY() >= SafetyStrip::height);
        CHECK (w.view->isParentOf (&menu));
    };
    withMenu (w, *w.titled ("Menu"), juce::ModifierKeys::leftButtonModifier, isClear);
    withMenu (w, w.view->canvas(), juce::ModifierKeys::rightButtonModifier, isClear);
}

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
