// SPDX-License-Identifier: MIT
#include "host/app/support/canvas_rig.hpp"

#include "support/temporary_folder.hpp"

#include <host/app/run/hand_panel.hpp>
#include <host/app/run/hand_view.hpp>
#include <host/app/take/take.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <functional>
#include <thread>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
struct Rig
{
    TemporaryFolder home;
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    Sound sound;
    DeviceSetup setup;
    Playback playback { rig.document, catalogue(), sound, setup, [] {} };
    LiveRun& run { playback.run() };

    template <typename F>
    bool until (F&& isSo)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds (20);
        while (! isSo() && std::chrono::steady_clock::now() < end)
        {
            playback.attend();
            std::this_thread::sleep_for (std::chrono::milliseconds (2));
        }
        return isSo();
    }

    void press()
    {
        HandView view { playback };
        view.setSize (400, 300);
        view.steer (0.0, 0.0, true);
    }

    void choose (int item)
    {
        HandPanel panel { playback, sound };
        panel.setSize (420, 260);
        for (auto* child : panel.getChildren())
            if (auto* box = dynamic_cast<juce::ComboBox*> (child)) box->setSelectedItemIndex (item, juce::sendNotificationSync);
    }

    /// What starts a run, other than START.
    std::vector<std::pair<const char*, std::function<void()>>> starts()
    {
        return { { "a press into the tool view", [this] { press(); } },
                 { "the choice of a gesture", [this] { choose (2); } },
                 { "the choice of the pointer", [this] { choose (1); } },
                 { "the recording of a take", [this] { Take (playback).record(); } },
                 { "another graph", [this] { playback.startOther ({}); } } };
    }
};
}   // namespace

TEST_CASE ("only START and REARM end a latched stop: no press into the tool view, gesture, take or opened graph does", "[app][run][safety]")
{
    const int which = GENERATE (range (0, 5));
    const bool is_over = GENERATE (false, true), is_previewed = GENERATE (false, true);
    Rig r;
    r.playback.start ({});
    REQUIRE (r.until ([&] { return r.run.isRunning(); }));
    r.playback.emergencyStop();
    REQUIRE (r.until ([&] { return r.run.isStoppedForGood(); }));
    if (is_over)
    {
        r.playback.stop();
        REQUIRE (r.until ([&] { return ! r.run.isRunning(); }));
    }
    if (is_previewed)
    {
        r.playback.preview (CanvasRig::preset ("dry_wood"));
        r.playback.endPreview();
    }

    const auto [what, start] = r.starts()[static_cast<std::size_t> (which)];
    INFO (what << (is_over ? " after the run was over" : "") << (is_previewed ? " after a preview" : ""));
    start();
    REQUIRE (r.until ([&] { return r.run.isRunning(); }));
    CHECK (r.until ([&] { return r.run.isStoppedForGood(); }));
    for (int k = 0; k < 50; ++k)
    {
        r.playback.attend();
        REQUIRE (r.run.status()->force == 0.0);
        std::this_thread::sleep_for (std::chrono::milliseconds (1));
    }

    r.playback.restart();   // START
    REQUIRE (r.until ([&] { return r.run.isRunning() && ! r.run.isStoppedForGood(); }));
}

TEST_CASE ("a hand that is chosen while nothing is stopped starts the run", "[app][run]")
{
    Rig r;
    for (const auto& [what, start] : r.starts())
    {
        INFO (what);
        start();
        REQUIRE (r.until ([&] { return r.run.isRunning(); }));
        CHECK_FALSE (r.run.isHeld());
        r.run.letGo();
    }
}
