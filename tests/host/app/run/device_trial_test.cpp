// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/app/run/playback.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <chrono>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;

namespace
{
struct TrialRig
{
    TemporaryFolder home;
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    Sound sound;
    DeviceSetup setup;
    Playback playback { rig.document, catalogue(), sound, setup, [] {} };

    template <typename F>
    bool until (F&& isSo)
    {
        return tactus::test::eventually (std::chrono::milliseconds (2), [&] {
            playback.poll();
            return isSo();
        });
    }
};

RoleNeeds needing (bool force, int signals)
{
    RoleNeeds needs { "tip", {} };
    needs.parts.force = force;
    needs.parts.others.signal_outputs = signals;
    return needs;
}
}   // namespace

TEST_CASE ("the test of a device pushes gently, once, and then the graph runs again", "[app][device_trial]")
{
    TrialRig r;
    r.playback.start ({});
    REQUIRE (r.until ([&] { return r.playback.run().isRunning(); }));
    REQUIRE (r.playback.tryDevice ("stylus"));
    CHECK (r.playback.tryDevice ("stylus").error().id == "device_trial/stopped");   // one at a time
    double strongest = 0.0, limit = 0.0;
    REQUIRE (r.until ([&] {
        if (! r.playback.isTrying()) return true;
        if (const auto tool = r.playback.current().tool()) strongest = std::max (strongest, tool->force.norm());
        limit = r.playback.current().mostForce().value_or (limit);
        return false;
    }));
    CHECK (limit > 0.0);
    CHECK (strongest > 0.0);
    CHECK (strongest <= DeviceTrial::share * limit + 1e-9);
    CHECK (r.until ([&] { return r.playback.run().isRunning(); }));
}

TEST_CASE ("a device is not tested while the forces are off, and a stop ends the test for good", "[app][device_trial]")
{
    TrialRig r;
    CHECK (r.playback.tryDevice ("stylus").error().id == "device_trial/stopped");
    r.playback.start ({});
    REQUIRE (r.until ([&] { return r.playback.run().isRunning(); }));
    CHECK (r.playback.tryDevice ("no_such_role").error().id == "device_trial/no_motor");
    REQUIRE (r.playback.tryDevice ("stylus"));
    r.playback.stop();
    CHECK (r.until ([&] { return ! r.playback.isTrying(); }));
    CHECK_FALSE (r.playback.run().isWanted());
}

TEST_CASE ("a latched stop during the test of a device stays latched when the graph runs again, and its limits stay", "[app][device_trial][safety]")
{
    TrialRig r;
    r.playback.start ({});
    REQUIRE (r.until ([&] { return r.playback.run().isRunning(); }));
    const auto asked = r.playback.run().mostForce();
    REQUIRE (r.playback.tryDevice ("stylus"));
    REQUIRE (r.until ([&] { return r.playback.current().isRunning(); }));
    const_cast<LiveRun&> (r.playback.current()).emergencyStop();   // as an alarm of the failsafe does
    REQUIRE (r.until ([&] { return ! r.playback.isTrying() && r.playback.run().isRunning(); }));
    CHECK (r.until ([&] { return r.playback.run().isStoppedForGood(); }));
    CHECK (r.playback.run().isHeld());
    CHECK (r.playback.run().mostForce() == asked);
}

TEST_CASE ("a test reaches at most a tenth of the limits of the guard, and pushes nothing without a limit", "[app][device_trial]")
{
    const auto force = DeviceTrial::of ({}, needing (true, 1)), signal = DeviceTrial::of ({}, needing (false, 1));
    REQUIRE (force);
    REQUIRE (signal);
    CHECK_FALSE (DeviceTrial::of ({}, needing (false, 0)));
    CHECK (force->level ({}, {}) == 0.0);
    CHECK (rc::check ([&] {
        const double limit = *rc::gen::inRange (1, 10'000) * 1e-2;
        RC_ASSERT (force->level (limit, {}) <= 0.1 * limit);
        RC_ASSERT (force->level (limit, {}) <= DeviceTrial::most_force_N);
        RC_ASSERT (signal->level ({}, limit) <= 0.1 * limit);
    }));
    for (const auto* trial : { &*force, &*signal })
        CHECK (compile (trial->graph, catalogue()).plan != nullptr);
}
