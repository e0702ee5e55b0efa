// SPDX-License-Identifier: MIT
#include "host/app/support/canvas_rig.hpp"

#include <host/app/run/hand_panel.hpp>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

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
