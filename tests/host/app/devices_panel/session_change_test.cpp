// SPDX-License-Identifier: GPL-3.0-or-later
// Another program, such as `tactus session`, changes the session while the panel of devices is on the desk.
#include "host/app/support/desk_rig.hpp"
#include "host/app/support/wait_for.hpp"

#include "support/waiting.hpp"

#include <host/app/devices_panel/devices_panel.hpp>
#include <host/app/devices_panel/session_change.hpp>
#include <host/devices/audio/card.hpp>
#include <host/devices/sessions/session_file.hpp>

using namespace tactus;
using namespace tactus::host;
using tactus::host::test::DeskRig;

namespace
{
struct Rig : DeskRig
{
    DevicesPanel& panel_of_devices;

    Rig() : DeskRig ("dry_wood.json"), panel_of_devices (make<DevicesPanel> (devicesPanel))
    {
        panel_of_devices.setVisible (true);
        playback.start (LiveRun::Hand {});
        REQUIRE (until ([&] { return run().isRunning(); }));
    }

    LiveRun& run() { return playback.run(); }

    template <typename F>
    bool until (F&& isSo)
    {
        return tactus::test::eventually ({}, [&] {
            work();
            return isSo();
        });
    }

    /// Does what `tactus session` does.
    void otherwise (const std::function<void (DeviceSession&)>& change)
    {
        const auto edited = editSession (loadDefaultSession (home.path()), change);
        REQUIRE (edited.isGood());
    }

    /// As the window does while it is open.
    void work()
    {
        refresh();
        tactus::host::test::settle (5);
    }
};

const Json tap { { "driver", "gesture" }, { "path", "tap" } }, board { { "driver", "hid" }, { "profile", "tactus_board" } };
}   // namespace

TEST_CASE ("a device that another program binds is noticed, and drives nothing before START", "[app][sessions][safety]")
{
    Rig r;
    r.otherwise ([] (DeviceSession& s) { s.bind ("stylus", board); });
    REQUIRE (r.until ([&] { return ! r.run().isWanted(); }));
    CHECK (r.said.contains ("stylus: hid tactus_board"));
    CHECK (r.said.contains ("START"));
    CHECK (tactus::test::stays (std::chrono::milliseconds (300), [&] {
        r.work();
        return ! r.run().isWanted() && ! r.run().drivesDevice();
    }));
    r.document.perform (graph::SetParam { "", "drag", "mu", 0.3 });   // nor does an edit
    CHECK_FALSE (r.run().isWanted());
    r.playback.restart();   // as START does
    CHECK (r.until ([&] { return r.run().drivesDevice(); }));
    r.run().letGo();
}

TEST_CASE ("a change of the clock does not bind what another program has bound since", "[app][sessions][safety]")
{
    Rig r;
    r.otherwise ([] (DeviceSession& s) { s.bind ("stylus", board); });
    r.panel_of_devices.bindings().chooseClock ("timer");   // before the window has looked at the file
    CHECK_FALSE (r.run().isWanted());
    CHECK (r.said.contains ("stylus: hid tactus_board"));
    const auto saved = loadDefaultSession (r.home.path());
    CHECK (saved.session.clock() == "timer");   // both changes are kept
    REQUIRE (saved.session.binding ("stylus") != nullptr);
    CHECK (tactus::test::stays (std::chrono::milliseconds (300), [&] {
        r.work();
        return ! r.run().drivesDevice();
    }));
}

TEST_CASE ("a change that does not concern the run is said, and the run goes on", "[app][sessions]")
{
    Rig r;
    r.otherwise ([] (DeviceSession& s) { s.bind ("other", tap); });
    CHECK (r.until ([&] { return r.said.contains ("other: gesture tap"); }));
    CHECK (r.run().isRunning());
    r.home.write ("session.json", "{ \"format\": ");   // a program is still writing it
    CHECK (tactus::test::stays (std::chrono::milliseconds (300), [&] {
        r.work();
        return r.run().isRunning() && ! std::filesystem::exists (r.home / "session.json.broken");
    }));
}

TEST_CASE ("a sound card that is missing cannot be the clock", "[app][sessions]")
{
    Rig r;
    const auto cards = audio::soundCards().list();
    const bool has_one = std::ranges::any_of (cards, [] (const auto& c) { return c.trouble.empty() && ! c.outputs.empty(); });
    r.panel_of_devices.bindings().chooseClock ("audio");
    CHECK ((loadDefaultSession (r.home.path()).session.clock() == "audio") == has_one);
    CHECK (r.said.contains ("cannot be the clock") == ! has_one);
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
