// SPDX-License-Identifier: GPL-3.0-or-later
// A key that the window has never seen come up does not count as held for ever.
#include "host/app/support/screen.hpp"
#include "host/app/support/wait_for.hpp"

#include <host/base/juce/native_window.hpp>

#include <catch2/catch.hpp>

#include <vector>

using namespace tactus::host;
using namespace tactus::host::test;

namespace
{
/// A window that notes its keys.
struct KeysWindow final : private Application, public juce::Component
{
    KeysWindow()
    {
        setBounds (100, 100, 400, 300);
        setOpaque (true);
        setWantsKeyboardFocus (true);
        addToDesktop (0);
        setVisible (true);
        other.setBounds (600, 100, 100, 100);
        other.addToDesktop (0);
        other.setVisible (true);
        toFront (true);
        REQUIRE (tactus::host::test::waitFor ([&] { return hasKeyboardFocus (false); }));
    }

    void paint (juce::Graphics& g) override { g.fillAll (juce::Colours::black); }

    bool keyPressed (const juce::KeyPress& key) override
    {
        keys.push_back (key);
        return true;
    }

    /// The key that arrives when xdotool presses one.
    juce::KeyPress pressed (const std::string& key)
    {
        keys.clear();
        xdo ("key " + key);
        REQUIRE (tactus::host::test::waitFor ([&] { return ! keys.empty(); }));
        return keys.front();
    }

    /// A window of the program gets the event that Alt goes down, and none that it comes up. To a window without the keyboard, xdotool sends the event
    /// itself, so the X server does not count the key as held.
    void pressAltForEver()
    {
        xdo ("keydown --window " + std::to_string (reinterpret_cast<std::uintptr_t> (other.getPeer()->getNativeHandle())) + " alt");
        REQUIRE (tactus::host::test::waitFor ([] { return juce::ModifierKeys::currentModifiers.isAltDown(); }));
    }

    juce::Component other;
    std::vector<juce::KeyPress> keys;
};
}   // namespace

TEST_CASE ("on a screen: a release that another program got", "[.screen]")
{
    KeysWindow w;
    w.pressAltForEver();
    CHECK (w.pressed ("space").getModifiers().isAltDown());   // as JUCE counts
    takeHeldKeysFromEvents();
    takeHeldKeysFromEvents();   // a second call changes nothing
    for (const auto* key : { "space", "ctrl+z", "ctrl+s", "ctrl+shift+s" })
    {
        INFO (key);
        w.pressAltForEver();
        const auto got = w.pressed (key);
        CHECK_FALSE (got.getModifiers().isAltDown());
        CHECK (got.getModifiers().isCtrlDown() == std::string (key).starts_with ("ctrl"));
        CHECK (got.getModifiers().isShiftDown() == (std::string (key).find ("shift") != std::string::npos));
    }
    CHECK (w.pressed ("alt+a").getModifiers().isAltDown());   // a key that is held counts
}

TEST_CASE ("after Alt+Tab back to the window, where another program gets the release of Alt, keys do what they should", "[app][keyboard]")
{
    onScreen ("on a screen: a release that another program got");
}
