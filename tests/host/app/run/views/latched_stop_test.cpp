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

    /// An action other than START that starts a run. One that only chooses a hand starts nothing that a person has stopped.
    struct Start
    {
        const char* what;
        std::function<void()> act;
        bool stays_over;
    };
    static constexpr int hand_choices = 4;

    std::vector<Start> starts()
    {
        return { { "a press into the tool view", [this] { press(); }, true },
                 { "the choice of a gesture", [this] { choose (2); }, true },
                 { "the choice of the pointer", [this] { choose (1); }, true },
                 { "a recording that is dropped", [this] { playback.moveBy ({ LiveRun::Hand::Kind::path, "circle" }); }, true },
                 { "the recording of a take", [this] { Take (playback).record(); }, true },
                 { "another graph", [this] { playback.startOther ({}); }, false } };
    }

    bool staysOver()
    {
        return tactus::test::stays (std::chrono::milliseconds (50), [&] {
            playback.poll();
            return ! run.isRunning() && ! run.isWanted();
        });
    }
};
}   // namespace

TEST_CASE ("only START and REARM end a latched stop: no press into the tool view, gesture, take or opened graph does", "[app][run][safety]")
{
    const int which = GENERATE (range (0, 6));
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

    const auto start = r.starts()[static_cast<std::size_t> (which)];
    INFO (start.what << (is_over ? " after the run was over" : "") << (is_previewed ? " after a preview" : ""));
    start.act();
    if (start.stays_over && (is_over || is_previewed))
        CHECK (r.staysOver());
    else
    {
        const bool is_running = r.until ([&] { return r.run.isRunning(); });
        INFO (r.state());
        REQUIRE (is_running);
        CHECK (r.until ([&] { return r.run.isStoppedForGood(); }));
        CHECK (tactus::test::stays (std::chrono::milliseconds (50), [&] {
            r.playback.poll();
            return r.run.status()->force == 0.0;
        }));
    }
    CHECK_FALSE (r.playback.stopSwitch().mayStart());   // no program ends the stop either

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
    CHECK (r.staysOver());
    r.playback.restart();   // START
    CHECK (r.until ([&] { return r.run.isRunning() && ! r.run.isStoppedForGood(); }));
}

TEST_CASE ("a hand that is chosen while nothing is stopped starts the run", "[app][run]")
{
    Rig r;
    for (const auto& start : r.starts())
    {
        INFO (start.what);
        start.act();
        REQUIRE (r.until ([&] { return r.run.isRunning(); }));
        CHECK_FALSE (r.run.isHeld());
        r.run.letGo();
    }
}

TEST_CASE ("what a person has stopped starts only by START: another hand does not start it", "[app][run][safety]")
{
    const int which = GENERATE (range (0, Rig::hand_choices));
    const bool was_started = GENERATE (false, true);   // else it was recovered without running
    Rig r;
    if (was_started)
    {
        r.playback.start ({});
        REQUIRE (r.until ([&] { return r.run.isRunning(); }));
    }
    r.playback.stop();
    REQUIRE (r.until ([&] { return ! r.run.isRunning(); }));
    const auto start = r.starts()[static_cast<std::size_t> (which)];
    INFO (start.what);
    start.act();
    CHECK (r.staysOver());
    CHECK (r.run.hand() != LiveRun::Hand {});   // it is chosen, for the next start
    const auto chosen = r.run.hand();
    r.playback.restart();   // START
    CHECK (r.until ([&] { return r.run.isRunning(); }));
    CHECK (r.run.hand() == chosen);
}
