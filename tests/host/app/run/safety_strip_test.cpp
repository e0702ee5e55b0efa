// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include <host/app/run/safety_strip.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <thread>

using namespace tactus;
using namespace tactus::host;
using namespace tactus::host::test;

namespace
{
juce::Button* buttonCalled (juce::Component& in, const juce::String& text)
{
    for (auto* child : in.getChildren())
        if (auto* button = dynamic_cast<juce::Button*> (child); button != nullptr && button->isVisible() && button->getButtonText() == text) return button;
    return nullptr;
}
}   // namespace

TEST_CASE ("REARM never appears in the place of STOP", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    Sound sound;
    DeviceSetup setup;
    Playback playback { rig.document, catalogue(), sound, setup, [] {} };
    auto& run = playback.run();
    SafetyStrip strip { playback };
    Look look;
    strip.setLookAndFeel (&look);
    strip.setSize (1280, SafetyStrip::height);
    const auto until = [&] (auto isSo) {
        for (int i = 0; i < 2000; ++i)
        {
            run.attend();
            strip.refresh();
            if (isSo()) return true;
            std::this_thread::sleep_for (std::chrono::milliseconds (5));
        }
        return false;
    };
    strip.refresh();
    REQUIRE (buttonCalled (strip, "START"));
    run.start ({});
    REQUIRE (until ([&] { return buttonCalled (strip, "STOP") != nullptr; }));
    CHECK (buttonCalled (strip, "REARM") == nullptr);
    const auto place = buttonCalled (strip, "STOP")->getBounds();

    run.emergencyStop();
    REQUIRE (until ([&] { return buttonCalled (strip, "REARM") != nullptr; }));
    REQUIRE (buttonCalled (strip, "STOP"));
    CHECK (buttonCalled (strip, "STOP")->getBounds() == place);
    CHECK_FALSE (buttonCalled (strip, "REARM")->getBounds().intersects (place));

    CHECK_FALSE (buttonCalled (strip, "REARM")->isEnabled());   // a double click on STOP must not rearm
    buttonCalled (strip, "REARM")->onClick();
    CHECK (run.isStoppedForGood());
    REQUIRE (until ([&] { return buttonCalled (strip, "REARM")->isEnabled(); }));
    buttonCalled (strip, "REARM")->onClick();
    CHECK (until ([&] { return buttonCalled (strip, "REARM") == nullptr && run.isRunning(); }));
    run.emergencyStop();
    buttonCalled (strip, "STOP")->onClick();
    CHECK (until ([&] { return ! run.isRunning(); }));
    strip.setLookAndFeel (nullptr);
}
