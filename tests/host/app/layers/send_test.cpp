// SPDX-License-Identifier: GPL-3.0-or-later
// Layers that are sent to a vibration motor while the graph runs, and the tool that the mouse moves.
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/follows_mouse.hpp"

#include <host/app/layers/layers_panel.hpp>

#include <algorithm>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskStage;
using tactus::host::test::followsMouse;
using tactus::host::test::waitFor;

namespace
{
bool needs (LiveRun& run, const std::string& role) { return std::ranges::count (run.needs(), role, &RoleNeeds::role) > 0; }

/// Adds a mixer, and sends a layer to a new vibration motor.
void send (DeskStage& w, const juce::String& layer)
{
    w.show<LayersPanel> (layersPanel);
    w.click ("Add a mixer before the motor");
    auto* button = w.titled ("Send " + layer + " to another device");
    REQUIRE (button != nullptr);
    w.choose (w.middleOf (*button), 1, juce::ModifierKeys::leftButtonModifier);
    REQUIRE (w.graph().root.find ("shaker") != nullptr);
}

}   // namespace

TEST_CASE ("a force that contact gates is sent to a new vibration motor, and the run goes on", "[app][layers]")
{
    DeskStage w ("dry_wood.json");
    auto& run = w.playback.run();
    REQUIRE (w.start());
    send (w, "grain_felt");
    for (const auto& m : run.messages())
        CHECK (m.severity != Message::Severity::error);
    CHECK (waitFor ([&] { return run.isRunning() && needs (run, "shaker"); }));
    run.letGo();
}

TEST_CASE ("a new vibration motor does not take the mouse from the tool", "[app][layers][hand]")
{
    const bool by_mouse = GENERATE (true, false);
    DeskStage w (by_mouse ? "templates/stroke.json" : "dry_wood.json");
    w.showHand();
    auto& run = w.playback.run();
    REQUIRE (w.start (by_mouse ? LiveRun::Hand::pointer() : LiveRun::Hand {}));
    CHECK ((run.hand().kind == LiveRun::Hand::Kind::pointer) == by_mouse);
    send (w, "drag");
    REQUIRE (waitFor ([&] { return run.isRunning() && needs (run, "shaker") && run.tool(); }));
    CHECK (run.handRole() == "stylus");
    CHECK (followsMouse (w, run));
    CHECK (run.hand() == LiveRun::Hand::pointer());
    CHECK (w.titled ("Which tool the hand moves") == nullptr);   // a vibration motor is no tool
    w.click ("3D");
    REQUIRE (waitFor ([&] { return ! run.scene().now().tools.empty(); }));
    CHECK (run.scene().now().tools.size() == 1);
    run.letGo();
}
