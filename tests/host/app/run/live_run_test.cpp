// SPDX-License-Identifier: GPL-3.0-or-later
#include "host/app/support/canvas_rig.hpp"

#include "host/devices/hid_link/fake_board.hpp"
#include "support/guardian.hpp"
#include "support/temporary_folder.hpp"
#include "support/waiting.hpp"

#include <host/app/run/device_setup.hpp>
#include <host/app/run/live_run.hpp>
#include <host/devices/failsafe/failsafe.hpp>

#include <tactus/file/graph_file.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>

#include <unistd.h>

using namespace tactus;
using namespace tactus::host;
using host::test::CanvasRig;
using tactus::test::BoardProfile;
using tactus::test::FakeBoard;

namespace
{
/// Attends to a run until the condition holds.
template <typename F>
bool until (
    LiveRun& p, F&& isSo, const std::function<void()>& meanwhile = [] {})
{
    return tactus::test::eventually (std::chrono::milliseconds (2), [&] {
        meanwhile();
        p.poll();
        return isSo();
    });
}

/// The forces that the motor receives, tick by tick, while the user does something else.
std::vector<std::uint64_t> bitsOf (CanvasRig& rig, std::size_t ticks, const std::function<void()>& meanwhile)
{
    LiveRun p { rig.document, catalogue() };
    Traces::Client probe { p.traces() };
    probe.want ({ "motor.force" });
    p.start ({});
    const auto traces = [&] { return probe.of ("motor.force"); };
    REQUIRE (until (
        p, [&] { return traces().size() == 3 && traces()[0]->end() >= ticks; },
        meanwhile));
    std::vector<std::uint64_t> bits;
    for (std::size_t k = 0; k < ticks; ++k)
        for (const auto& t : traces())
            bits.push_back (std::bit_cast<std::uint64_t> (k >= t->begin() ? t->at (k) : std::numeric_limits<double>::quiet_NaN()));
    return bits;
}

bool isLost (std::uint64_t bits) { return std::isnan (std::bit_cast<double> (bits)); }
}   // namespace

TEST_CASE ("nothing the user does in the window changes the forces at the motor", "[app][run]")
{
    constexpr std::size_t ticks = 6000;
    CanvasRig quiet { CanvasRig::preset ("dry_wood") }, busy { CanvasRig::preset ("dry_wood") };
    const auto expected = bitsOf (quiet, ticks, [] {});
    int n = 0;
    const auto got = bitsOf (busy, ticks, [&] {
        ++n;
        // There and back, so that the drag stays clear of other nodes and does not change their params.
        const auto way = juce::Point<float> (16.0f, 8.0f) * (n % 2 == 0 ? 1.0f : -1.0f);
        busy.hand().drag (busy.title ("drag"), busy.title ("drag") + way);
        busy.hand().wheel ({ 300.0f, 300.0f }, n % 2 == 0 ? 0.1f : -0.1f);
        if (n % 3 == 0) busy.canvas->setSize (900 + n % 300, 600 + n % 200);
        if (n % 4 == 0) busy.canvas->createComponentSnapshot (busy.canvas->getLocalBounds());
        if (n % 10 == 0)
        {
            busy.hand().key ("ctrl + z");
            busy.hand().key ("ctrl + y");
        }
    });
    CHECK (busy.graph().root.find ("drag")->params == quiet.graph().root.find ("drag")->params);
    CHECK (n > 5);

    std::size_t compared = 0, different = 0, forces = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
        if (isLost (expected[i]) || isLost (got[i])) continue;
        ++compared;
        different += expected[i] != got[i] ? 1 : 0;
        forces += std::bit_cast<double> (expected[i]) != 0.0 ? 1 : 0;
    }
    CHECK (different == 0);
    CHECK (compared > expected.size() / 2);   // a busy machine may drop some probe samples
    CHECK (forces > 1000);
}

TEST_CASE ("stop removes the forces, start restores them, and an edit does not restart a stopped run", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun p { rig.document, catalogue() };
    CHECK_FALSE (p.isRunning());
    rig.hand().click (rig.title ("grain"));
    rig.hand().key ("b");
    CHECK_FALSE (p.isRunning());

    p.start ({});
    REQUIRE (until (p, [&] { return p.status()->peak > 0.1; }));
    p.stop();
    REQUIRE (until (p, [&] { return ! p.isRunning(); }));
    CHECK (p.status()->force == 0.0);
    rig.hand().key ("b");
    p.poll();
    CHECK_FALSE (p.isRunning());
    p.start (LiveRun::Hand::pointer());
    CHECK (until (p, [&] { return p.isRunning() && p.tool().has_value(); }));
}

TEST_CASE ("the emergency stop removes the forces while the graph keeps running, until it is rearmed", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun p { rig.document, catalogue() };
    p.emergencyStop();   // with nothing running
    CHECK_FALSE (p.isStoppedForGood());
    p.start ({});
    const auto force = [&] { return p.status()->force; };
    REQUIRE (until (p, [&] { return force() > 0.1; }));
    CHECK_FALSE (p.isStoppedForGood());

    p.emergencyStop();
    REQUIRE (until (p, [&] { return p.isStoppedForGood() && force() == 0.0; }));
    const auto tick = p.status()->ticks;
    REQUIRE (until (p, [&] { return p.status()->ticks > tick + 400; }));
    CHECK (force() == 0.0);
    rig.hand().key ("b");   // an edit does not bring the force back
    p.poll();
    CHECK (p.isStoppedForGood());

    rig.document.perform (graph::SetHeader { .rate_hz = 5000.0 });   // nor does an edit that restarts the run
    REQUIRE (until (p, [&] { return p.isRunning() && p.rate() == 5000.0 && p.status()->ticks > 8000; }));
    CHECK (p.isStoppedForGood());
    CHECK (p.status()->peak == 0.0);

    CHECK (until (p, [&] { return p.canRearm(); }));   // a second after the stop
    p.rearm();
    CHECK (until (p, [&] { return force() > 0.1; }));
    CHECK_FALSE (p.isStoppedForGood());
    p.emergencyStop();
    p.start ({});   // starting the run by hand also clears the stop
    CHECK (until (p, [&] { return p.isRunning() && force() > 0.1; }));
}

TEST_CASE ("an alarm of the failsafe removes the forces until someone rearms, and the messages say why", "[app][run]")
{
    const TemporaryFolder folder;
    std::ofstream { folder / "device" }.close();
    const auto failsafe = Failsafe::arm ((folder / "device").string(), { { { 0 }, false } });
    REQUIRE (failsafe);
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun p { rig.document, catalogue() };
    p.start ({});
    const auto force = [&] { return p.status()->force; };
    REQUIRE (until (p, [&] { return force() > 0.1; }));
    REQUIRE (until (p, [&] { return tactus::test::guardianOf (::getpid()) > 0; }));
    ::kill (tactus::test::guardianOf (::getpid()), SIGKILL);
    const auto saysWhy = [&] { return std::ranges::any_of (p.messages(), [] (const Message& m) { return m.id == "run/unguarded"; }); };
    REQUIRE (until (p, [&] { return p.isStoppedForGood() && force() == 0.0 && saysWhy(); }));
    CHECK (p.isRunning());

    CHECK (until (p, [&] { return p.canRearm(); }));   // a second after the alarm
    p.rearm();
    CHECK (until (p, [&] { return force() > 0.1; }));
}

TEST_CASE ("the tool follows the mouse, and meets the surface where the mouse points", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("soft_pad") };
    LiveRun p { rig.document, catalogue() };
    p.start (LiveRun::Hand::pointer());
    p.point ({ 0.01, -0.02, 0.005 });
    REQUIRE (until (p, [&] { return p.tool() && (p.tool()->position - Vec3 (0.01, -0.02, 0.005)).norm() < 1e-3; }));
    CHECK (p.tool()->force.norm() < 1e-3);
    p.point ({ 0.01, -0.02, -0.004 });
    CHECK (until (p, [&] { return p.tool()->force.z() > 0.1; }));
}

TEST_CASE ("under a tool that the mouse holds in a wall, a run that begins again does not kick", "[app][run][safety]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun p { rig.document, catalogue() };
    Traces::Client probe { p.traces() };
    probe.want ({ "motor.applied" });
    p.start (LiveRun::Hand::pointer());
    p.point ({ 0.0, 0.0, -0.004 });
    REQUIRE (until (p, [&] { return p.tool() && p.tool()->force.z() > 0.3; }));

    const double rate = p.rate() / 2.0;
    rig.document.perform (graph::SetHeader { .rate_hz = rate });
    const auto pushes = [&] { return probe.of ("motor.applied"); };
    const auto ramp = static_cast<std::uint64_t> (Guard::rearm_ramp_s * rate);
    REQUIRE (until (p, [&] { return p.isRunning() && p.rate() == rate && pushes().size() == 3 && pushes()[2]->end() > 3 * ramp; }));
    const auto& up = *pushes()[2];
    const auto at = [&] (std::uint64_t tick) { return tick >= up.begin() && std::isfinite (up.at (tick)) ? up.at (tick) : 0.0; };
    const double settled = at (3 * ramp);
    double most = 0.0, step = at (0);
    for (std::uint64_t k = 1; k <= 3 * ramp; ++k)
    {
        most = std::max (most, at (k));
        step = std::max (step, std::abs (at (k) - at (k - 1)));
    }
    CHECK (settled > 0.3);
    CHECK (most <= 1.1 * settled);
    CHECK (step <= 0.03 * settled);                                                                         // without a ramp, the first tick brings all of it
    CHECK (std::ranges::none_of (p.messages(), [] (const Message& m) { return m.id == "watch/guard"; }));   // the graph asks for no other guard
    CHECK (std::ranges::all_of (p.keptLimits(), [] (const auto& kept) { return kept.second.ramp == 0.0; }));
}

TEST_CASE ("if an edit breaks a running graph, the previous graph keeps running and the problem is reported", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun p { rig.document, catalogue() };
    p.start ({});
    REQUIRE (until (p, [&] { return p.tool().has_value(); }));
    rig.hand().drag (rig.port ("drag", Role::output, "deflection"), rig.port ("drag", Role::input, "position"));
    graph::Wire loop;
    loop.from = { "drag", "deflection" };
    loop.to = { "drag", "position" };
    for (const auto& w : rig.graph().root.wires)
        if (w.to == loop.to) rig.document.perform (graph::RemoveWire { {}, w.id });
    rig.document.perform (graph::AddWire { {}, loop });
    CHECK (hasErrors (p.messages()));
    CHECK (p.messages().front().id == "graph/loop");
    CHECK (p.isRunning());
    rig.document.undo();
    CHECK_FALSE (hasErrors (p.messages()));
}

TEST_CASE ("a device that is not plugged in is reported", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const TemporaryFolder home;
    DeviceSetup setup;
    setup.open (home.path());
    REQUIRE (setup.edit ([] (DeviceSession& s) {
        s.bind ("stylus", Json { { "driver", "hid" }, { "profile", "tactus_board" }, { "serial", "none has this" } });
    }));
    LiveRun p { rig.document, catalogue() };
    p.use (setup);
    p.start ({});
    const auto said = p.messages();
    REQUIRE (std::ranges::count (said, "hid/not_connected", &Message::id) == 1);
    CHECK (std::ranges::find (said, "hid/not_connected", &Message::id)->where.starts_with ("/roles/stylus"));
}

TEST_CASE ("a run does not start without the device of a driver in a plugin, unless the mouse takes the role", "[app][run][safety]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const TemporaryFolder home;
    DeviceSetup setup;
    setup.open (home.path());
    REQUIRE (setup.edit ([] (DeviceSession& s) { s.bind ("stylus", { { "driver", "not_installed" }, { "port", "a" } }); }));
    LiveRun p { rig.document, catalogue() };
    p.use (setup);
    p.start ({});
    CHECK_FALSE (p.isRunning());
    CHECK_FALSE (p.isWanted());
    REQUIRE (std::ranges::count (p.messages(), "device/unknown_driver", &Message::id) == 1);
    CHECK (std::ranges::find (p.messages(), "device/unknown_driver", &Message::id)->where.starts_with ("/roles/stylus"));

    p.start (LiveRun::Hand::pointer());
    CHECK (until (p, [&] { return p.isRunning() && p.status()->ticks > 10; }));
    p.start ({});
    CHECK (until (p, [&] { return ! p.isRunning() && ! p.isWanted(); }));
    REQUIRE (setup.edit ([] (DeviceSession& s) { s.unbind ("stylus"); }));
    p.start ({});
    CHECK (p.isRunning());
}

TEST_CASE ("a graph that names a device which is plugged in does not open it, but the session does", "[app][run]")
{
    const TemporaryFolder home;
    FakeBoard board;
    const hid::LoadedProfiles profiles { .profiles = { BoardProfile {}.make() }, .messages = {} };
    DeviceSetup setup { board, profiles };
    setup.open (home.path());
    const Json on_board { { "driver", "hid" }, { "profile", "board" } };
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun p { rig.document, catalogue() };
    p.use (setup);
    setup.onChange = [&] { p.setupChanged(); };
    const auto isSaid = [&] { return std::ranges::count (p.messages(), "device/not_by_graph", &Message::id) == 1; };
    const auto runs = [&] { return p.isRunning() && p.status()->ticks > 10; };

    p.start ({});
    REQUIRE (until (p, runs));
    rig.document.perform (graph::SetDevice { "stylus", on_board });   // restarts the run
    CHECK (until (p, [&] { return isSaid() && runs(); }));
    p.start (LiveRun::Hand::pointer());
    CHECK (until (p, [&] { return isSaid() && runs(); }));
    CHECK_FALSE (p.drivesDevice());
    CHECK (p.clockRole().empty());
    CHECK (board.openings() == 0);

    p.start ({});
    REQUIRE (setup.edit ([&] (DeviceSession& s) { s.bind ("stylus", on_board); }));
    CHECK (until (p, [&] { return board.openings() == 1 && p.drivesDevice(); }));
    CHECK_FALSE (isSaid());
}

TEST_CASE ("a missing sound card is reported, and the run continues without it", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const TemporaryFolder home;
    DeviceSetup setup;
    setup.open (home.path());
    LiveRun p { rig.document, catalogue() };
    p.use (setup);
    setup.onChange = [&] { p.setupChanged(); };
    const auto play = [&] (const char* sound) { REQUIRE (setup.edit ([&] (DeviceSession& s) { s.setAudio (Json::parse (sound)); })); };
    play (R"({ "output": "no such card", "routes": [ { "port": "drag.force.x", "channel": 1, "full_scale": "4 N" } ] })");
    CHECK_FALSE (p.audioStatus());
    p.start ({});
    CHECK (std::ranges::count (p.messages(), "audio/no_card", &Message::id) == 1);
    CHECK_FALSE (hasErrors (p.messages()));
    REQUIRE (p.audioStatus());
    CHECK_FALSE (p.audioStatus()->is_open);
    CHECK (until (p, [&] { return p.status()->ticks > 100; }));

    play (R"({ "output": "no such card", "routes": [ { "port": "drag.forse.x", "channel": 1 } ] })");   // restarts the run
    CHECK (until (p, [&] { return std::ranges::count (p.messages(), "audio/port", &Message::id) == 1; }));
    CHECK_FALSE (hasErrors (p.messages()));
    CHECK (until (p, [&] { return p.isRunning() && p.status()->ticks > 100; }));
}

TEST_CASE ("the role of a sound card never becomes the hand, even if it comes first", "[app][run]")
{
    const TemporaryFolder folder;
    std::ifstream preset (TACTUS_SOURCE_DIR "/graphs/dry_wood.json");
    auto json = Json::parse (std::string { std::istreambuf_iterator<char> (preset), {} });
    json["nodes"]["shake"] = { { "type", "device.signal_out" }, { "role", "a_shaker" } };   // its name comes before "stylus"
    json["devices"]["a_shaker"] = { { "driver", "audio" }, { "card", "no such card" } };
    json["wires"].push_back ("grain.value -> shake.in");
    const auto file = folder.path() / "graph.json";
    std::ofstream (file) << json;
    CanvasRig rig { loadGraph (file).graph };
    LiveRun p { rig.document, catalogue() };
    p.start (LiveRun::Hand::pointer());
    p.point (Vec3 (0.01, 0.0, -0.002));
    CHECK (until (p, [&] { return p.tool() && p.tool()->position.z() < 0.0 && p.tool()->force.z() > 0.1; }));
    CHECK (p.stiffnessLeft());
    p.start ({});   // moved by the stylus's own gesture
    CHECK (until (p, [&] { return p.isRunning() && p.transport() != nullptr && p.status()->peak > 0.1; }));
}

TEST_CASE ("if a run's clock is a sound card that is missing, its forces stay at zero", "[app][run]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    const TemporaryFolder home;
    DeviceSetup setup;
    setup.open (home.path());
    REQUIRE (setup.edit ([] (DeviceSession& s) {
        s.setClock ("audio");
        s.setAudio ({ { "output", "no such card" } });
    }));
    LiveRun p { rig.document, catalogue() };
    p.use (setup);
    p.start ({});
    REQUIRE (until (p, [&] { return p.status() && p.status()->ticks > 1000; }));
    CHECK (p.status()->clock_replaced);
    CHECK (p.audioStatus()->by_timer);
    CHECK (p.status()->peak == 0.0);
}

TEST_CASE ("in the window, an edit tightens a guard at once, and what it loosens waits for START, even if the run restarts by itself", "[app][run][safety]")
{
    CanvasRig rig { CanvasRig::preset ("dry_wood") };
    LiveRun p { rig.document, catalogue() };
    p.start ({});
    REQUIRE (until (p, [&] { return p.isRunning(); }));
    const auto before = p.mostForce();
    REQUIRE (before);
    REQUIRE (*before > 0.5);
    const auto guarded = [&] (const Json& most, double rate_hz) {
        auto g = rig.graph();
        for (auto& [role, description] : g.devices)
        {
            if (most.is_null())
                description.erase ("guard");
            else
                description["guard"]["max_force"] = most;
        }
        g.rate_hz = rate_hz;
        rig.document.open (std::move (g), {}, "another guard");
    };
    const auto isSaid = [&] { return std::ranges::any_of (p.messages(), [] (const Message& m) { return m.id == "watch/guard"; }); };
    const double rate = p.rate();

    guarded ("0.5 N", rate);
    CHECK (p.isRunning());   // no restart
    CHECK (p.mostForce() == 0.5);
    CHECK_FALSE (isSaid());
    rig.document.undo();
    CHECK (p.mostForce() == 0.5);
    CHECK (isSaid());
    guarded ({}, rate);
    CHECK (p.mostForce() == 0.5);
    CHECK (isSaid());

    guarded ({}, 0.5 * rate);   // needs a restart
    REQUIRE (until (p, [&] { return p.isRunning() && p.rate() == 0.5 * rate; }));
    CHECK (p.mostForce() == 0.5);
    CHECK (isSaid());

    p.start ({});
    REQUIRE (until (p, [&] { return p.isRunning() && p.mostForce() != 0.5; }));
    CHECK_FALSE (isSaid());
}
