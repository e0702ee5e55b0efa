// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/app/run/views/hand_panel.hpp>
#include <host/app/run/views/hand_view.hpp>
#include <host/app/take/take.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <functional>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
/// At a rate that a busy machine can keep: a run that cannot keep up ends.
graph::Graph slowWood()
{
    auto g = CanvasRig::preset ("dry_wood");
    g.rate_hz = 200.0;
    return g;
}

struct Rig
{
    TemporaryFolder home;
    CanvasRig rig { slowWood() };
    Sound sound;
    DeviceSetup setup;
    Playback playback { rig.document, catalogue(), sound, setup, [] {} };
    LiveRun& run { playback.run() };

    /// Waits until something is so, and stays so for a while: a run that is asked to start again ends first.
    template <typename F>
    bool until (F&& isSo)
    {
        int times = 0;
        return tactus::test::eventually (std::chrono::milliseconds (2), [&] {
            playback.poll();
            times = isSo() ? times + 1 : 0;
            return times == 20;
        });
    }

    std::string state()
    {
        std::string all = std::string (run.isRunning() ? "running" : "over") + (run.isWanted() ? ", wanted" : "") + (run.isHeld() ? ", held" : "")
                          + (run.isStoppedForGood() ? ", latched" : "");
        for (const auto& m : run.messages())
            all += "; " + m.text;
        return all;
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
        r.playback.preview (slowWood());
        r.playback.endPreview();
    }

    const auto [what, start] = r.starts()[static_cast<std::size_t> (which)];
    INFO (what << (is_over ? " after the run was over" : "") << (is_previewed ? " after a preview" : ""));
    start();
    const bool is_running = r.until ([&] { return r.run.isRunning(); });
    INFO (r.state());
    REQUIRE (is_running);
    CHECK (r.until ([&] { return r.run.isStoppedForGood(); }));
    CHECK (tactus::test::stays (std::chrono::milliseconds (50), [&] {
        r.playback.poll();
        return r.run.status()->force == 0.0;
    }));

    r.playback.restart();   // START
    const bool is_free = r.until ([&] { return r.run.isRunning() && ! r.run.isStoppedForGood(); });
    INFO (r.state());
    REQUIRE (is_free);
}

TEST_CASE ("an emergency stop during the test of a device or a preview holds the graph until START", "[app][run][safety]")
{
    const bool is_trial = GENERATE (false, true);
    Rig r;
    r.playback.start ({});
    REQUIRE (r.until ([&] { return r.run.isRunning(); }));
    if (is_trial)
        REQUIRE (r.playback.tryDevice ("stylus"));
    else
        r.playback.preview (slowWood());
    REQUIRE (r.until ([&] { return r.playback.current().isRunning(); }));
    r.playback.emergencyStop();
    if (! is_trial) r.playback.endPreview();
    REQUIRE (r.until ([&] { return ! r.playback.isPreviewing(); }));
    CHECK_FALSE (r.run.isWanted());
    CHECK (r.run.isHeld());
    r.press();
    CHECK (r.until ([&] { return r.run.isStoppedForGood(); }));
    r.playback.restart();   // START
    CHECK (r.until ([&] { return r.run.isRunning() && ! r.run.isStoppedForGood(); }));
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
