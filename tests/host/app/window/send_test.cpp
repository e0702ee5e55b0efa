// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that are sent to a vibration motor, and the tool that the mouse moves, in the window while the graph runs.
#include "host/app/support/window_rig.hpp"

#include <tactus/run/device/gestures.hpp>

#include <catch2/catch.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::waitFor;
using tactus::host::test::WindowRig;

namespace
{
bool needs (LiveRun& run, const std::string& role) { return std::ranges::count (run.needs(), role, &RoleNeeds::role) > 0; }

/// Adds a mixer, and sends a layer to a new vibration motor.
void send (WindowRig& w, const juce::String& layer)
{
    w.click ("Layers");
    w.click ("Add a mixer before the motor");
    auto* button = w.titled ("Send " + layer + " to another device");
    REQUIRE (button != nullptr);
    w.choose (w.middleOf (*button), 1, juce::ModifierKeys::leftButtonModifier);
    REQUIRE (w.graph().root.find ("shaker") != nullptr);
}

/// Presses on the surface at both of its sides. True if the tool goes there.
bool followsMouse (WindowRig& w)
{
    auto* surface = w.titled ("Surface");
    REQUIRE (surface != nullptr);
    const auto at = [&] (float part) {
        const auto area = surface->getLocalBounds().toFloat();
        return w.stage->getLocalPoint (surface, juce::Point<float> (part * (area.getWidth() - 64.0f), area.getCentreY()));
    };
    const auto isAt = [&] (double sign) {
        const auto tool = w.view->run().tool();
        return tool && sign * tool->position.x() > 0.02 && tool->position.z() < 0.0;
    };
    w.stage->move (at (0.2f));
    w.stage->press();
    const bool left = waitFor ([&] { return isAt (-1.0); });
    w.stage->move (at (0.8f));
    const bool right = waitFor ([&] { return isAt (1.0); });
    w.stage->release();
    return left && right;
}
}   // namespace

TEST_CASE ("a force that contact gates is sent to a new vibration motor, and the run goes on", "[app][layers]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& run = w.view->run();
    send (w, "grain_felt");
    for (const auto& m : run.messages())
        CHECK (m.severity != Message::Severity::error);
    CHECK (waitFor ([&] { return run.isRunning() && needs (run, "shaker"); }));
    run.letGo();
}

TEST_CASE ("a new vibration motor does not take the mouse from the tool", "[app][layers][hand]")
{
    const bool by_mouse = GENERATE (true, false);
    WindowRig w (by_mouse ? "" : "dry_wood.json", 1280, 720, false);
    if (by_mouse)
    {
        w.key ("ctrl + n");
        w.click ("Stroke");
    }
    auto& run = w.view->run();
    REQUIRE (waitFor ([&] { return run.isRunning(); }));
    CHECK ((run.hand().kind == LiveRun::Hand::Kind::pointer) == by_mouse);
    send (w, "drag");
    REQUIRE (waitFor ([&] { return run.isRunning() && needs (run, "shaker") && run.tool(); }));
    CHECK (run.handRole() == "stylus");
    CHECK (followsMouse (w));
    CHECK (run.hand() == LiveRun::Hand::pointer());
    CHECK (w.titled ("Which tool the hand moves") == nullptr);   // a vibration motor is no tool
    w.click ("3D");
    REQUIRE (waitFor ([&] { return ! run.scene().now().tools.empty(); }));
    CHECK (run.scene().now().tools.size() == 1);
    run.letGo();
}

TEST_CASE ("one chooses which of two fingers the mouse moves", "[app][hand]")
{
    WindowRig w ("two_fingers.json", 1280, 720, false);
    auto& run = w.view->run();
    REQUIRE (waitFor ([&] { return run.isRunning() && run.tool(); }));
    CHECK (run.toolRoles() == std::vector<std::string> { "index", "thumb" });
    CHECK (run.handRole() == "index");
    CHECK (followsMouse (w));
    WindowRig::settle (100);
    auto* fingers = dynamic_cast<juce::ComboBox*> (w.titled ("Which tool the hand moves"));
    REQUIRE (fingers != nullptr);
    CHECK (fingers->getText() == "index");
    CHECK (w.stage->getComponentAt (w.middleOf (*fingers).toInt())->isShowing());
    fingers->grabKeyboardFocus();
    w.key ("cursor down");
    CHECK (fingers->getText() == "thumb");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.handRole() == "thumb" && run.tool(); }));
    CHECK (run.hand() == LiveRun::Hand::pointer());
    CHECK (followsMouse (w));
    WindowRig::settle (100);
    CHECK (fingers->getText() == "thumb");

    run.stop();   // the choice lasts as long as the graph
    REQUIRE (waitFor ([&] { return ! run.isRunning(); }));
    w.key ("f5");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.tool(); }));
    CHECK (run.handRole() == "thumb");
    CHECK (followsMouse (w));
    w.view->open (TACTUS_SOURCE_DIR "/graphs/dry_wood.json");
    CHECK (run.handRole() == "stylus");
    CHECK (waitFor ([&] { return w.titled ("Which tool the hand moves") == nullptr; }));
    run.letGo();
}

TEST_CASE ("the mouse or the gesture that the user has chosen moves the next preset's tool, too, until the user chooses otherwise", "[app][hand]")
{
    WindowRig w ("dry_wood.json", 1280, 720, false);
    auto& run = w.view->run();
    REQUIRE (waitFor ([&] { return run.isRunning() && run.tool(); }));
    const auto list = [&] { return dynamic_cast<juce::ComboBox*> (w.titled ("What moves the tool")); };
    const auto choose = [&] (const char* key, const char* shown) {
        REQUIRE (list() != nullptr);
        list()->grabKeyboardFocus();
        w.key (key);
        CHECK (list()->getText() == shown);
    };
    const auto open = [&] (const char* preset) {
        w.key ("ctrl + f");
        w.stage->type (preset);
        WindowRig::settle();
        w.key ("return");
        REQUIRE (w.graph().name == preset);
        REQUIRE (waitFor ([&] { return run.isRunning() && run.tool(); }));
        WindowRig::settle (100);
    };
    open ("Liver");
    CHECK (run.hand() == LiveRun::Hand {});

    choose ("cursor down", "Mouse or pen");
    open ("Soft pad");
    CHECK (run.hand() == LiveRun::Hand::pointer());
    CHECK (list()->getText() == "Mouse or pen");
    CHECK (followsMouse (w));
    open ("Velvet");
    CHECK (run.hand() == LiveRun::Hand::pointer());

    choose ("cursor down", ("Gesture: " + std::string (gestures()[0].id)).c_str());
    open ("Liver");
    CHECK (run.hand() == LiveRun::Hand { LiveRun::Hand::Kind::path, std::string (gestures()[0].id) });

    choose ("cursor up", "Mouse or pen");
    choose ("cursor up", "Its own device");
    open ("Soft pad");
    CHECK (run.hand() == LiveRun::Hand {});
    CHECK (followsMouse (w));   // a press takes the tool for this graph only
    CHECK (run.hand() == LiveRun::Hand::pointer());
    open ("Velvet");
    CHECK (run.hand() == LiveRun::Hand {});
    run.letGo();
}
