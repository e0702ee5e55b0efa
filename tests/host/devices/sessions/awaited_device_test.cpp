// SPDX-License-Identifier: MIT
// A role whose device is missing when the run begins, or whose clock goes away: no force until everything works again.

#include "host/devices/hid_link/fake_board.hpp"
#include "host/devices/hid_link/socket_board.hpp"

#include <host/devices/sessions/binding.hpp>
#include <host/devices/sessions/device_health.hpp>
#include <host/devices/sessions/run_clock.hpp>
#include <tactus/run/device/sim.hpp>
#include <tactus/run/engine.hpp>
#include <tactus/run/runner.hpp>

#include "support/no_allocation.hpp"
#include "support/sketch.hpp"
#include "support/tick_thread_locks.hpp"
#include "support/waiting.hpp"

#include <catch2/catch.hpp>

#include <set>

using namespace tactus;
using namespace tactus::host;
using test::boardReport;
using test::eventually;
using test::FakeBoard;
using namespace std::chrono_literals;

namespace
{
const Json on_board { { "driver", "hid" }, { "profile", "board" } };

hid::LoadedProfiles profiles() { return { .profiles = { test::BoardProfile { .watchdog = 0.02 }.make() }, .messages = {} }; }

LoadedSession sessionWith (const Json& binding)
{
    LoadedSession s { {}, "desk/session.json" };
    s.session.bind ("stylus", binding);
    return s;
}

BoundDevice bindStylus (const Json& binding, hid::HidSystem& system, Absence absence = Absence::waits)
{
    const auto session = sessionWith (binding);
    const auto open = [&] (const Json& d, const std::filesystem::path& from) { return hid::openDevice (d, from, system, profiles()); };
    return openBound (session, "stylus", *bindingOf (session, "stylus"), open, system, profiles(), absence);
}

/// A constant force of 1 N, with a simulated tool next to it.
test::Sketch pushed()
{
    test::Sketch s;
    s.node ("push", "signal.constant", { { "value", 1.0 } })
        .node ("x", "vector.join")
        .node ("motor", "device.force")
        .node ("other", "device.force")
        .node ("hand", "device.position");
    s.wire ("push.out -> x.x").wire ("x.out -> motor.force").wire ("x.out -> other.force");
    s.graph.root.nodes[3].role = "beside";
    return s;
}

const AwaitedDevice& awaited (const BoundDevice& b) { return dynamic_cast<const AwaitedDevice&> (*b.driver); }
}   // namespace

TEST_CASE ("a role whose device is missing waits without force, and then starts from zero", "[sessions][hid]")
{
    FakeBoard board;
    const bool is_held_by_another = GENERATE (false, true);
    is_held_by_another ? board.forbid (true) : board.plug (false);

    auto bound = bindStylus (on_board, board);
    REQUIRE (bound.device);
    REQUIRE (bound.messages.size() == 1);
    CHECK (bound.messages.front().severity == Message::Severity::warning);
    CHECK (bound.messages.front().id == (is_held_by_another ? "hid/not_permitted" : "hid/not_connected"));
    CHECK (bound.messages.front().where.starts_with ("/roles/stylus"));
    CHECK (bound.messages.front().file == "desk/session.json");
    CHECK (bound.limits.max_force == 3.0);
    CHECK (bound.device->layout() == awaited (bound).layout());

    Guard guard;
    guard.prepare (bound.limits, 1e-3);
    AwaitedDevice device { on_board, awaited (bound).profile(), board, 2ms };
    device.prepare (1e-3);
    const auto tick = [&] {
        const auto applied = guard ({ { 1.0, 0.0, 0.0 }, Vec3::Zero() }, device.read());
        device.write (applied);
        return applied.force.x();
    };
    for (int k = 0; k < 50; ++k)
    {
        const auto reading = device.read();
        CHECK_FALSE (reading.valid);
        CHECK (reading.age > 0.0);
        CHECK (tick() == 0.0);
    }
    CHECK (guard.stop() == Guard::Stop::stale);
    CHECK (device.device() == nullptr);
    REQUIRE (eventually ([&] { return ! device.trouble().empty(); }));
    CHECK (board.told().empty());

    is_held_by_another ? board.forbid (false) : board.plug (true);
    REQUIRE (eventually ([&] { return device.device() != nullptr; }));
    std::uint16_t count = 0;
    double most_step = 0.0, before = 0.0;
    const bool reached = eventually ([&] {
        board.send (boardReport (++count));
        const double now = tick();
        most_step = std::max (most_step, now - before);
        before = now;
        return now == 1.0;
    });
    CHECK (reached);
    CHECK (most_step < 0.2);   // a ramp of 10 ms at 1 kHz
    NoAllocation none;
    tick();
    CHECK (none.allocations() == 0);
    CHECK (none.locks() == 0);
}

TEST_CASE ("errors that no device can fix are reported immediately, and with Absence::refuses, all errors are", "[sessions][hid]")
{
    FakeBoard board;
    board.plug (false);
    const auto idOf = [] (const BoundDevice& b) { return b.messages.empty() ? std::string() : b.messages.front().id; };
    const auto refused = [&] (const Json& binding, Absence absence, const std::string& id) {
        const auto bound = bindStylus (binding, board, absence);
        CHECK_FALSE (bound.device);
        CHECK (hasErrors (bound.messages));
        CHECK (idOf (bound) == id);
    };
    refused (on_board, Absence::refuses, "hid/not_connected");
    refused ({ { "driver", "hid" } }, Absence::waits, "hid/not_connected");   // any device may appear
    refused ({ { "driver", "hid" }, { "profile", "bord" } }, Absence::waits, "hid/unknown_profile");
    refused ({ { "driver", "hid" }, { "profile", "board" }, { "guard", { { "max_force", "1 mm" } } } }, Absence::waits, "hid/not_connected");
    refused ({ { "driver", "sim" }, { "workspace", { { "scale", 0 } } } }, Absence::waits, "device/out_of_range");
    refused ({ { "driver", "sim" }, { "mass", 0 } }, Absence::waits, "device/out_of_range");
    refused ({ { "driver", "sim" }, { "workspace", { { "clutch", "grip" } } } }, Absence::waits, "device/no_button");
    CHECK (bindStylus ({ { "driver", "sim" }, { "workspace", { { "clutch", "grip" } } } }, board).messages.front().where == "/roles/stylus/workspace/clutch");
}

TEST_CASE ("a session can only tighten the limits of a device's profile, in the graph's workspace", "[sessions][hid]")
{
    FakeBoard board;
    const auto bound = bindStylus ({ { "driver", "hid" },
                                     { "profile", "board" },
                                     { "guard", { { "max_force", 50.0 }, { "max_speed", 1.0 }, { "ramp", 0.5 } } },
                                     { "workspace", { { "scale", 0.5 } } } },
                                   board);
    REQUIRE (bound.device);
    CHECK (bound.messages.empty());
    CHECK (bound.limits.max_force == 3.0);
    CHECK (bound.limits.max_speed == 1.0);
    CHECK (bound.limits.workspace_scale == 0.5);
    CHECK (bound.limits.ramp == 0.5);
    CHECK (bound.driver != bound.device.get());
    CHECK (realDevice ("stylus", *bound.driver));
}

TEST_CASE ("while the clock of a run is away, no device gets a force, not even one with a valid reading", "[sessions][hid]")
{
    FakeBoard board;
    auto real = test::openBoard (board, { .watchdog = 0.01 });
    SimulatedDevice beside { {} };
    Engine engine { pushed().compile ({ .rate_hz = 1000.0 }).plan };
    engine.attach ("stylus", *real, hid::limitsOf (*real->port().profile(), {}));
    engine.attach ("beside", beside);
    RunClock clock { *real, 1000.0 };
    Runner runner { engine, clock, 1000.0, {} };
    std::atomic<bool> sending = true;
    std::jthread reports { [&] (const std::stop_token& over) {
        for (std::uint16_t n = 0; ! over.stop_requested(); test::letPass (1ms))
            if (sending) board.send (boardReport (++n));
    } };
    runner.start();
    const auto forces = [&] {
        const auto now = runner.status();
        std::set<double> all;
        for (const auto& role : now.shown())
            all.insert (role.force);
        return all;
    };
    CHECK (eventually ([&] { return forces() == std::set { 1.0 }; }));

    const bool by_cable = GENERATE (false, true);
    by_cable ? board.plug (false) : void (sending = false);
    CHECK (eventually ([&] { return runner.status().clock_replaced && forces() == std::set { 0.0 }; }));
    const auto held = runner.status();
    CHECK (held.roles[0].stop == Guard::Stop::stale);   // "beside", whose own reading is still valid
    CHECK (held.roles[1].stop == Guard::Stop::stale);
    CHECK (clock.isByTimer());

    by_cable ? board.plug (true) : void (sending = true);
    CHECK (eventually ([&] { return ! runner.status().clock_replaced && forces() == std::set { 1.0 }; }));
    reports = {};
    sending = false;
    runner.stop();
    runner.wait();
    CHECK (clock.ticksByTimer() > 0);
}

TEST_CASE ("a run with an awaited clock is ticked by a timer at its rate, without force, until the clock is available", "[sessions][hid]")
{
    FakeBoard board;
    board.plug (false);
    AwaitedDevice real { on_board, test::BoardProfile { .watchdog = 0.02 }.make(), board, 2ms };
    SimulatedDevice beside { {} };
    Engine engine { pushed().compile ({ .rate_hz = 1000.0 }).plan };
    engine.attach ("stylus", real, hid::limitsOf (*real.profile(), {}));
    engine.attach ("beside", beside);
    RunClock clock { real, 1000.0 };
    Runner runner { engine, clock, 1000.0, {} };
    runner.start();
    REQUIRE (eventually ([&] { return runner.status().ticks > 30; }));
    CHECK (runner.status().clock_replaced);
    CHECK (runner.status().peak == 0.0);
    CHECK (clock.ticksByTimer() >= 30);

    board.plug (true);
    std::jthread reports { [&] (const std::stop_token& over) {
        for (std::uint16_t n = 0; ! over.stop_requested(); test::letPass (1ms))
            board.send (boardReport (++n));
    } };
    CHECK (eventually ([&] { return ! clock.isByTimer() && runner.status().force == 1.0; }));
    runner.stop();
    runner.wait();
}

TEST_CASE ("a run that is still waiting for its clock can be stopped", "[sessions][hid]")
{
    FakeBoard board;
    board.plug (false);
    AwaitedDevice real { on_board, test::BoardProfile { .watchdog = 0.02 }.make(), board, 2ms };
    Engine engine { pushed().compile ({ .rate_hz = 1000.0 }).plan };
    engine.attach ("stylus", real);
    RunClock clock { real, 1000.0 };
    Runner runner { engine, clock, 1000.0, { .length = 20 } };
    runner.start();
    runner.wait();
    CHECK (runner.status().end == RunStatus::End::length);
    CHECK (clock.ticksByTimer() == runner.status().ticks);
}

TEST_CASE ("the state of a device is reported while it is awaited, while it is present, and after it has gone", "[sessions][hid]")
{
    FakeBoard board;
    board.plug (false);
    AwaitedDevice real { on_board, test::BoardProfile { .watchdog = 0.02 }.make(), board, 2ms };
    real.prepare (1e-3);
    const auto device = realDevice ("stylus", real);
    REQUIRE (device);
    HealthWatch watch { "stylus" };
    REQUIRE (eventually ([&] {
        watch.poll (std::span (&*device, 1));
        return ! watch.health().front().trouble.empty();
    }));
    CHECK_FALSE (watch.health().front().has_come);
    CHECK (describe (watch.health().front()).find ("not available yet") == 0);

    board.plug (true);
    std::uint16_t n = 0;
    CHECK (eventually ([&] {
        board.send (boardReport (++n));
        real.read();
        watch.poll (std::span (&*device, 1));
        return watch.health().front().rate_hz.has_value();
    }));
    const auto there = watch.health().front();
    CHECK (there.connected);
    CHECK (there.ticks);
    CHECK_FALSE (there.drift_ppm);   // it is the reference for other devices
    CHECK (there.reports > 2);
    CHECK (describe (there).find ("reports/s") != std::string::npos);

    board.plug (false);
    CHECK (eventually ([&] {
        watch.poll (std::span (&*device, 1));
        return ! watch.health().front().connected;
    }));
    CHECK (describe (watch.health().front()).find ("unplugged") == 0);
    auto gone = watch.health().front();
    gone.trouble.clear();
    CHECK (describe (gone) == "unplugged");
    gone.trouble = "its port is taken";
    CHECK (describe (gone) == "unplugged: its port is taken");
    CHECK_FALSE (watch.health().front().rate_hz);
}

TEST_CASE ("the drift of a device is the speed of its clock relative to the clock of the run", "[sessions][hid]")
{
    FakeBoard boards[2];
    const auto owner = test::openBoard (boards[0]), follower = test::openBoard (boards[1]);
    const std::vector<RealDevice> devices { { "stylus", owner.get(), nullptr }, { "thumb", follower.get(), nullptr } };
    HealthWatch by_device { "stylus", 0.05 }, too_early { "stylus" };
    std::uint16_t n = 0, m = 0;
    const bool measured = eventually ([&] {
        for (int k = 0; k < 4; ++k)
            boards[0].send (boardReport (++n));
        for (int k = 0; k < 5; ++k)
            boards[1].send (boardReport (++m));   // 5 for every 4 of the other board, however fast the machine is
        test::letPass (2ms);
        owner->read();
        follower->read();
        by_device.poll (devices);
        too_early.poll (devices);
        return n > 400 && by_device.health()[1].drift_ppm;
    });
    REQUIRE (measured);
    const auto& thumb = by_device.health()[1];
    CHECK (*thumb.drift_ppm == Approx (250'000.0).epsilon (0.1));
    CHECK (thumb.drift_error_ppm > 0.0);
    CHECK_FALSE (by_device.health()[0].drift_ppm);
    CHECK_FALSE (too_early.health()[1].drift_ppm);
    CHECK (describe (thumb).find ("ppm") != std::string::npos);
}

TEST_CASE ("a board whose rate is not that of its profile is reported, and a pause of the computer is not", "[sessions][hid]")
{
    FakeBoard board;
    board.virtual_ns = 1'000'000'000;
    const auto device = test::openBoard (board);   // 1000 Hz
    const std::vector<RealDevice> devices { { "stylus", device.get(), nullptr } };
    HealthWatch watch { "stylus" };
    std::uint16_t number = 0;
    std::uint64_t all = 0;
    const auto look = [&] (double seconds, int reports) {
        board.virtual_ns += static_cast<std::int64_t> (1e9 * seconds);   // first: the reading thread notes when each report arrives
        for (int k = 0; k < reports; ++k)
            board.send (boardReport (++number));
        all += static_cast<std::uint64_t> (reports);
        REQUIRE (eventually ([&] { return device->port().counts().reports == all; }));
        device->read();
        watch.poll (devices);
    };
    const auto isWarned = [&] { return watch.health().front().warning.has_value(); };

    bool was_warned = false;
    for (int k = 0; k < 200; ++k)   // 10 s, 1 % too fast, and now and then a report late
    {
        look (0.05, k % 2 == 0 ? 52 : 49);
        was_warned = was_warned || isWarned();
    }
    look (0.7, 0);   // the computer stands still, and the system drops what comes: the numbers show it
    number += 700;
    for (int k = 0; k < 100; ++k)
    {
        look (0.05, 50);
        was_warned = was_warned || isWarned();
    }
    look (0.5, 0);   // the board stands still
    for (int k = 0; k < 100; ++k)
    {
        look (0.05, 50);
        was_warned = was_warned || isWarned();
    }
    // Stalls, one after the other: a span with a gap says nothing about the rate.
    for (int stall = 0; stall < 4; ++stall)
    {
        look (4.0, 1);
        for (int k = 0; k < 8; ++k)
        {
            look (0.05, 50);
            was_warned = was_warned || isWarned();
        }
    }
    CHECK_FALSE (was_warned);

    double after = 0.0;
    while (! isWarned() && after < 10.0)
    {
        look (0.05, 25);
        after += 0.05;
    }
    CHECK (after < 6.5);
    REQUIRE (isWarned());
    CHECK (watch.health().front().warning->id == "device/rate");
    CHECK (watch.health().front().warning->text == "the board sends 500 reports/s, its profile says 1000: the graph runs at 50 % of its speed");
    CHECK (describe (watch.health().front()).find ("50 % of its speed") != std::string::npos);
    for (int k = 0; k < 100; ++k)
        look (0.05, 50);
    CHECK_FALSE (isWarned());
}

TEST_CASE ("ticks of a HID device take no locks, by its reports, by the timer that stands in, and before it is there", "[sessions][hid][clocks]")
{
#if defined(__linux__)
    // The tick thread reads this one itself.
    test::SocketBoard sockets;
    auto opened = hid::HidPort::open (sockets, {}, test::BoardProfile {}.make(), { .look_again = 1h, .real_time = false });
    REQUIRE (opened);
    hid::HidDevice direct { std::move (*opened) };
    direct.prepare (1e-3);
    RunClock read { direct, 1000.0 };
    std::uint16_t sent = 0;
    test::checkThatTicksLockNothing (read, &direct, 200, [&] {
        ++sent;
        sockets.send (boardReport (sent, sent));
        test::letPass (1ms);
    });
    CHECK (direct.port().counts().read_by_tick > 0);
    RunClock nothing_to_read { direct, 1000.0 };
    test::checkThatTicksLockNothing (nothing_to_read, nullptr, 50, [] { test::letPass (1ms); });
#endif

    FakeBoard board;
    board.can_read_until = false;   // its mutex would count
    const auto device = test::openBoard (board);
    std::uint16_t count = 0;
    RunClock reported { *device, 1000.0 };
    test::checkThatTicksLockNothing (reported, device.get(), 200, [&] {
        ++count;
        board.send (boardReport (count, count));
        test::letPass (1ms);
    });
    RunClock silent { *device, 1000.0 };
    test::checkThatTicksLockNothing (silent, nullptr, 50, [] { test::letPass (1ms); });

    FakeBoard nowhere;
    nowhere.plug (false);
    AwaitedDevice missing { on_board, test::BoardProfile {}.make(), nowhere, 2ms };
    RunClock awaiting { missing, 1000.0 };
    test::checkThatTicksLockNothing (awaiting, &missing, 50, [] { test::letPass (1ms); });
}
