// SPDX-License-Identifier: GPL-3.0-or-later
// Menus and the palette over a graph that runs: Esc stops first, and STOP stays within reach.
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
