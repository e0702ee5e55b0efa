// SPDX-License-Identifier: GPL-3.0-or-later
// Another program, such as `tactus session`, changes the session while the window is open.
#include "host/app/support/window_rig.hpp"

#include "support/waiting.hpp"

#include <host/app/devices_panel/session_change.hpp>
#include <host/devices/audio/card.hpp>
#include <host/devices/sessions/session_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::WindowRig;

namespace
{
struct Rig : WindowRig
{
    Rig() : WindowRig ("dry_wood.json", 1280, 720, false)
    {
        REQUIRE (until ([&] { return view->run().isRunning(); }));
    }

    template <typename F>
    bool until (F&& isSo)
    {
        return tactus::test::eventually ({}, [&] {
            settle (5);
            return isSo();
        });
    }

    /// Does what `tactus session` does.
    void otherwise (const std::function<void (DeviceSession&)>& change)
    {
        const auto edited = editSession (loadDefaultSession (home.path()), change);
        REQUIRE (edited.isGood());
    }

    juce::String noticeText() const { return view->statusText(); }
};

const Json tap { { "driver", "gesture" }, { "path", "tap" } }, board { { "driver", "hid" }, { "profile", "tactus_board" } };
}   // namespace

TEST_CASE ("a device that another program binds is noticed, and drives nothing before START", "[app][sessions][safety]")
{
    Rig r;
    r.otherwise ([] (DeviceSession& s) { s.bind ("stylus", board); });
    REQUIRE (r.until ([&] { return ! r.view->run().isWanted(); }));
    CHECK (r.noticeText().contains ("stylus: hid tactus_board"));
    CHECK (r.noticeText().contains ("START"));
    CHECK (tactus::test::stays (std::chrono::milliseconds (300), [&] {
        r.settle (5);
        return ! r.view->run().isWanted() && ! r.view->run().drivesDevice();
    }));
    r.view->document().perform (graph::SetParam { "", "drag", "mu", 0.3 });   // nor does an edit
    CHECK_FALSE (r.view->run().isWanted());
    r.key ("F5");   // as START does
    CHECK (r.until ([&] { return r.view->run().drivesDevice(); }));
    r.view->run().letGo();
}

TEST_CASE ("a change of the clock does not bind what another program has bound since", "[app][sessions][safety]")
{
    Rig r;
    r.click ("Devices");
    r.otherwise ([] (DeviceSession& s) { s.bind ("stylus", board); });
    r.view->devicesPanel().chooseClock ("timer");   // before the window has looked at the file
    CHECK_FALSE (r.view->run().isWanted());
    CHECK (r.noticeText().contains ("stylus: hid tactus_board"));
    const auto saved = loadDefaultSession (r.home.path());
    CHECK (saved.session.clock() == "timer");   // both changes are kept
    REQUIRE (saved.session.binding ("stylus") != nullptr);
    CHECK (tactus::test::stays (std::chrono::milliseconds (300), [&] {
        r.settle (5);
        return ! r.view->run().drivesDevice();
    }));
}

TEST_CASE ("a change that does not concern the run is said, and the run goes on", "[app][sessions]")
{
    Rig r;
    r.otherwise ([] (DeviceSession& s) { s.bind ("other", tap); });
    CHECK (r.until ([&] { return r.noticeText().contains ("other: gesture tap"); }));
    CHECK (r.view->run().isRunning());
    r.home.write ("session.json", "{ \"format\": ");   // a program is still writing it
    CHECK (tactus::test::stays (std::chrono::milliseconds (300), [&] {
        r.settle (5);
        return r.view->run().isRunning() && ! std::filesystem::exists (r.home / "session.json.broken");
    }));
}

TEST_CASE ("a sound card that is missing cannot be the clock", "[app][sessions]")
{
    Rig r;
    r.click ("Devices");
    const auto cards = audio::soundCards().list();
    const bool has_one = std::ranges::any_of (cards, [] (const auto& c) { return c.trouble.empty() && ! c.outputs.empty(); });
    r.view->devicesPanel().chooseClock ("sound card");
    CHECK ((loadDefaultSession (r.home.path()).session.clock() == "audio") == has_one);
    CHECK (r.noticeText().contains ("cannot be the clock") == ! has_one);
}

TEST_CASE ("what another program has changed is said role by role", "[app][sessions]")
{
    const juce::ScopedJuceInitialiser_GUI gui;
    DeviceSession before, now;
    before.bind ("stylus", board);
    before.bind ("index", tap);
    now.bind ("index", tap);
    now.setClock ("timer");
    CHECK (changeText (before, now) == "stylus: as in the graph, clock: timer");
    CHECK (changeText (now, before) == "stylus: hid tactus_board, clock: automatic");
}
