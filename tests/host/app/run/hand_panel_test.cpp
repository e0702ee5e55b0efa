// SPDX-License-Identifier: MIT
#include "../support/canvas_rig.hpp"

#include <host/app/run/hand_panel.hpp>

using namespace tactus;
using namespace tactus::host;
using test::CanvasRig;

TEST_CASE ("the sliders of a gesture can be turned after its run has gone and before that is seen", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    Sound sound;
    HandPanel panel { sound };
    panel.setSize (420, 260);
    std::vector<juce::Slider*> sliders;
    for (auto* child : panel.getChildren())
        if (auto* slider = dynamic_cast<juce::Slider*> (child)) sliders.push_back (slider);
    REQUIRE (sliders.size() == 2);
    {
        Performance p { rig.document, catalogue() };
        p.start ({ Performance::Hand::Kind::path, "stroke" });
        REQUIRE (p.transport() != nullptr);
        panel.show (p);
        p.letGo();
    }
    for (auto* slider : sliders)
    {
        REQUIRE (slider->isVisible());
        slider->setValue (0.5, juce::sendNotificationSync);
    }
}
