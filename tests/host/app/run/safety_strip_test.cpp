// SPDX-License-Identifier: GPL-3.0-or-later
#include "../support/canvas_rig.hpp"

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

TEST_CASE ("what rearms is never where the stop is", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    Performance p { rig.document, catalogue() };
    SafetyStrip strip;
    Look look;
    strip.setLookAndFeel (&look);
    strip.setSize (1280, SafetyStrip::height);
    const auto until = [&] (auto come)
    {
        for (int i = 0; i < 2000; ++i)
        {
            p.attend();
            strip.show (p);
            if (come()) return true;
            std::this_thread::sleep_for (std::chrono::milliseconds (5));
        }
        return false;
    };
    int stops = 0;
    strip.onStop = [&]
    {
        ++stops;
        p.stop();
    };
    strip.onRearm = [&]
    { p.rearm(); };

    strip.show (p);
    REQUIRE (buttonCalled (strip, "START"));
    p.start ({});
    REQUIRE (until ([&]
                    { return buttonCalled (strip, "STOP") != nullptr; }));
    CHECK (buttonCalled (strip, "REARM") == nullptr);
    const auto place = buttonCalled (strip, "STOP")->getBounds();

    p.emergencyStop();
    REQUIRE (until ([&]
                    { return buttonCalled (strip, "REARM") != nullptr; }));
    REQUIRE (buttonCalled (strip, "STOP"));
    CHECK (buttonCalled (strip, "STOP")->getBounds() == place);
    CHECK_FALSE (buttonCalled (strip, "REARM")->getBounds().intersects (place));

    buttonCalled (strip, "REARM")->onClick();
    CHECK (until ([&]
                  { return buttonCalled (strip, "REARM") == nullptr && p.isRunning(); }));
    p.emergencyStop();
    buttonCalled (strip, "STOP")->onClick();
    CHECK (stops == 1);
    CHECK (until ([&]
                  { return ! p.isRunning(); }));
    strip.setLookAndFeel (nullptr);
}
