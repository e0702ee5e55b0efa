// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/desk_stage.hpp"
#include "host/app/support/follows_mouse.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/run/views/hand_panel.hpp>
#include <tactus/run/device/gestures.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using host::test::DeskStage;
using host::test::followsMouse;
using host::test::OnStage;
using host::test::waitFor;

TEST_CASE ("the transport sliders can be moved after the run has ended and before the panel shows it", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    Sound sound;
    DeviceSetup setup;
    Playback playback { rig.document, catalogue(), sound, setup, [] {} };
    HandPanel panel { playback, sound };
    panel.setSize (420, 260);
    std::vector<juce::Slider*> sliders;
    for (auto* child : panel.getChildren())
        if (auto* slider = dynamic_cast<juce::Slider*> (child)) sliders.push_back (slider);
    REQUIRE (sliders.size() == 2);
    playback.start ({ LiveRun::Hand::Kind::path, "stroke" });
    REQUIRE (playback.run().transport() != nullptr);
    panel.refresh();
    playback.run().letGo();
    for (auto* slider : sliders)
    {
        REQUIRE (slider->isVisible());
        slider->setValue (0.5, juce::sendNotificationSync);
    }
}

TEST_CASE ("each source of the hand can be read in the panel, also in 3D and at its usual width", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    Sound sound;
    DeviceSetup setup;
    Playback playback { rig.document, catalogue(), sound, setup, [] {} };
    HandPanel panel { playback, sound };
    const auto [width, scene] = GENERATE (table<int, bool> ({ { 420, false }, { 420, true }, { 800, true } }));
    panel.setSize (width, 260);
    panel.showScene (scene);
    const auto find = [&]() -> juce::ComboBox& {
        for (auto* child : panel.getChildren())
            if (auto* box = dynamic_cast<juce::ComboBox*> (child)) return *box;
        throw std::runtime_error ("no list");
    };
    auto& sources = find();
    REQUIRE (sources.getNumItems() == 2 + static_cast<int> (gestures().size()));
    for (int i = 0; i < sources.getNumItems(); ++i)
    {
        sources.setSelectedItemIndex (i, juce::dontSendNotification);
        const auto texts = host::test::readTexts (sources);
        INFO (sources.getItemText (i) << " at " << width << " pixels" << (scene ? " in 3D" : ""));
        CHECK (std::ranges::any_of (texts, [&] (const auto& t) { return t.text == sources.getItemText (i) && ! t.is_cut; }));
    }
}

TEST_CASE ("the scene shows no tool and no force once the run has stopped", "[app][run]")
{
    DeskStage w ("dry_wood.json");
    auto& scene = w.showHand().scene();
    w.click ("3D");
    REQUIRE (w.start());
    REQUIRE (waitFor ([&] { return scene.getDescription().contains ("N"); }));
    w.playback.run().stop();   // as STOP does: it lets the forces fall first
    REQUIRE (waitFor ([&] { return ! w.playback.run().isRunning(); }));
    CHECK (waitFor ([&] { return scene.getDescription().isEmpty(); }));
}

TEST_CASE ("one chooses which of two fingers the mouse moves", "[app][hand]")
{
    DeskStage w ("two_fingers.json");
    w.showHand();
    auto& run = w.playback.run();
    REQUIRE (w.start());
    CHECK (run.toolRoles() == std::vector<std::string> { "index", "thumb" });
    CHECK (run.handRole() == "index");
    CHECK (followsMouse (w, run));
    OnStage::settle (100);
    auto* fingers = dynamic_cast<juce::ComboBox*> (w.titled ("Which tool the hand moves"));
    REQUIRE (fingers != nullptr);
    CHECK (fingers->getText() == "index");
    CHECK (w.stage->getComponentAt (w.middleOf (*fingers).toInt())->isShowing());
    fingers->grabKeyboardFocus();
    w.key ("cursor down");
    CHECK (fingers->getText() == "thumb");
    REQUIRE (waitFor ([&] { return run.isRunning() && run.handRole() == "thumb" && run.tool(); }));
    CHECK (run.hand() == LiveRun::Hand::pointer());
    CHECK (followsMouse (w, run));
    OnStage::settle (100);
    CHECK (fingers->getText() == "thumb");

    run.stop();   // the choice lasts as long as the graph
    REQUIRE (waitFor ([&] { return ! run.isRunning(); }));
    w.playback.restart();
    REQUIRE (waitFor ([&] { return run.isRunning() && run.tool(); }));
    CHECK (run.handRole() == "thumb");
    CHECK (followsMouse (w, run));
    w.openAndStart ("dry_wood.json");
    CHECK (run.handRole() == "stylus");
    CHECK (waitFor ([&] { return w.titled ("Which tool the hand moves") == nullptr; }));
    run.letGo();
}
