// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"
#include "host/app/support/seen_text.hpp"

#include <host/app/run/views/hand_panel.hpp>
#include <tactus/run/device/gestures.hpp>

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
