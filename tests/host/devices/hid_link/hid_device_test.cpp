// SPDX-License-Identifier: MIT
// A HID device in a run, on a wire that can be cut: what is read, what is sent, and when nothing may be sent.

#include "fake_board.hpp"

#include "support/no_allocation.hpp"
#include "support/no_system_calls.hpp"
#include "support/temporary_folder.hpp"

#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>

using namespace tactus;
using namespace tactus::host::hid;
using test::boardReport;
using test::Bytes;
using test::eventually;
using test::FakeBoard;
using test::openBoard;
using test::stays;
using namespace std::chrono_literals;

namespace
{
/// Sends a report and waits until the port has it.
void deliver (FakeBoard& board, HidDevice& device, Bytes report)
{
    const auto before = device.port().counts().reports;
    board.send (std::move (report));
    REQUIRE (eventually ([&] { return device.port().counts().reports > before; }));
}

Reading tell (FakeBoard& board, HidDevice& device, Bytes report)
{
    deliver (board, device, std::move (report));
    return device.read();
}

/// A device with its guard, as in an engine, and a graph that requests a constant force.
struct Driven
{
    explicit Driven (HidDevice& d, const GuardLimits& limits = {}) : device (d) { guard.prepare (limits, 1e-3); }

    Effort tick (double wanted = 1.0)
    {
        reading = device.read();
        return tick (Effort { { wanted, 0.0, 0.0 }, Vec3::Zero() });
    }

    Effort tick (const Effort& wanted)
    {
        const auto effort = guard (wanted, reading);
        device.write (effort);
        return effort;
    }

    HidDevice& device;
    Guard guard;
    Reading reading;
};

std::size_t driven (const FakeBoard& board)
{
    return static_cast<std::size_t> (std::ranges::count_if (board.told(), &test::Told::isDriven));
}
}   // namespace

TEST_CASE ("on opening and closing, a device gets the steps of its profile", "[hid]")
{
    FakeBoard board;
    openBoard (board).reset();
    const auto told = board.told();
    REQUIRE (told.size() == 6);
    CHECK (told[0].how == test::Told::How::failsafe);   // first the failsafe: the neutral report and the exit
    CHECK (told[0].bytes.at (1) == 0x54);
    CHECK (told[1].how == test::Told::How::failsafe);
    CHECK (told[1].bytes == Bytes { 0, 0xaa, 0x03 });
    CHECK (told[2].bytes == Bytes { 0, 0xaa, 0x01 });
    CHECK (told[3].bytes == Bytes { 0, 0xaa, 0x02 });
    CHECK (told[3].how == test::Told::How::feature);
    CHECK (told[4].isNeutral());
    CHECK (told[5].bytes == Bytes { 0, 0xaa, 0x03 });
}

TEST_CASE ("a device with motors is not opened if nothing would bring it to rest when the program dies", "[hid][safety]")
{
    FakeBoard board;
    const auto open = [&] { return HidPort::open (board, board.what, test::BoardProfile {}.make(), { .look_again = 5ms, .real_time = false }); };
    board.no_failsafe = "device/failsafe";
    CHECK (open().error().id == "device/failsafe");
    CHECK (driven (board) == 0);
    board.no_failsafe = "device/no_failsafe";   // a system that has none: the device says so
    const auto without = open();
    REQUIRE (without);
    CHECK ((*without)->trouble().find ("the guardian is missing") != std::string::npos);
}

TEST_CASE ("bad reports change no value, invalidate the reading and are counted by reason", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    Driven run { *device };
    run.tick();
    CHECK_FALSE (run.reading.valid);   // no report has arrived

    REQUIRE (tell (board, *device, boardReport (1, 1'000'000)).valid);
    auto wrong_mark = boardReport (2, 7);
    wrong_mark[0] = 0x55;
    for (const auto& bad : { wrong_mark, Bytes (3, 0x54), Bytes (25, 0x54), Bytes (1000, 0x54) })
    {
        const auto reading = tell (board, *device, bad);
        CHECK_FALSE (reading.valid);
        CHECK (reading.position.x() == 1e-3);
        CHECK (reading.age > 0.0);
    }
    const auto again = tell (board, *device, boardReport (3, 2'000'000));
    CHECK (again.valid);
    CHECK (again.age == 0.0);
    CHECK (again.position.x() == 2e-3);

    const auto counts = device->counts();
    CHECK (counts.taken == 2);
    CHECK (counts.lost == 1);   // report 2, which was refused because of its wrong mark
    CHECK (counts.refused[static_cast<std::size_t> (Refusal::wrong_mark)] == 1);
    CHECK (counts.refused[static_cast<std::size_t> (Refusal::too_short)] == 1);
    CHECK (counts.refused[static_cast<std::size_t> (Refusal::too_long)] == 2);
}

TEST_CASE ("a motor of the force cannot be reached by an axis effort, whatever a graph asks for", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    CHECK (device->layout().efforts.empty());
    const GuardLimits limits { .max_force = 2.0, .max_slew = 100.0, .ramp = 0.01, .watchdog = 0.02 };
    Driven run { *device, limits };
    std::uint16_t count = 0;
    const auto efforts = [&] { return std::ranges::count_if (board.told(), &test::Told::isEffort); };
    for (int k = 0; k < 200; ++k)
    {
        deliver (board, *device, boardReport (++count));
        run.reading = device->read();
        Effort wanted { { k % 3 == 0 ? -5.0 : 5.0, 0.0, 0.0 }, Vec3::Zero() };
        wanted.axes = k % 50 < 40 ? Channels { 1000.0, -300.0, k % 7 == 0 ? -1e9 : 1e9 } : Channels {};   // fx, fy, fz
        const auto before = efforts();
        run.tick (wanted);
        REQUIRE (eventually ([&] { return efforts() > before; }));   // so that no report replaces an earlier one
    }
    CHECK (driven (board) > 150);

    Vec3 last = Vec3::Zero();
    double most = 0.0;
    for (const auto& told : board.told())
        if (told.isEffort())
        {
            const Vec3 now = 1e-6 * Vec3 { double (told.force (0)), double (told.force (1)), double (told.force (2)) };
            CHECK (now.norm() <= 2.0 + 2e-6);
            CHECK ((now - last).norm() <= 0.1 + 4e-6);
            most = std::max (most, now.norm());
            last = now;
        }
    CHECK (most > 1.5);
}

TEST_CASE ("sequence numbers reveal lost and reordered reports, even across the wrap-around", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    for (const int count : { 65533, 65534, 1, 2, 0, 3 })   // 65535 and 0 are lost, then 0 arrives late, and 1 and 2 count as lost
        deliver (board, *device, boardReport (static_cast<std::uint16_t> (count)));
    device->read();
    CHECK (device->counts().lost == 4);
    CHECK (device->counts().restarts == 1);
    CHECK (device->counts().taken == 6);
    CHECK (device->counts().skipped == 5);   // a single tick read all of them
}

TEST_CASE ("a device that falls silent under force gets no force after its watchdog", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    const GuardLimits limits { .ramp = 0.01, .watchdog = 0.02 };
    Driven run { *device, limits };
    std::uint16_t count = 0;
    const auto tickOn = [&] {
        deliver (board, *device, boardReport (++count));
        return run.tick().force.x();
    };
    REQUIRE (eventually ([&] { return tickOn() == 1.0; }));   // on a busy computer a reading may be too old at its tick, and the force rises again

    int ticks = 1;
    while (run.tick().force.x() > 0.0 && ticks < 100)
        ++ticks;
    CHECK (ticks <= 20 + 5 + 1);   // the watchdog and the guard's fade
    CHECK (run.guard.stop() == Guard::Stop::stale);
    CHECK (run.reading.age > 0.02);

    deliver (board, *device, boardReport (++count));
    CHECK (run.tick().force.x() < 0.2);   // then the force rises along the ramp
}

TEST_CASE ("a device unplugged under force goes to rest, and starts from zero when it is back", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    Driven run { *device, { .ramp = 0.01, .watchdog = 0.02 } };
    std::uint16_t count = 0;
    const auto tickOn = [&] {
        deliver (board, *device, boardReport (++count));
        return run.tick().force.x();
    };
    REQUIRE (eventually ([&] { return tickOn() == 1.0; }));

    board.plug (false);
    REQUIRE (eventually ([&] { return ! device->port().isConnected(); }));
    run.tick();
    CHECK_FALSE (run.reading.valid);
    for (int i = 0; i < 20; ++i)
        run.tick();
    CHECK (run.guard.isAtRest());
    const auto before = board.told().size();

    // The device comes back under a different path, as real devices do.
    board.what.path = "fake/1";
    board.plug (true);
    REQUIRE (eventually ([&] { return device->port().isConnected(); }));
    CHECK (board.openings() == 2);
    CHECK (device->port().counts().departures == 1);
    CHECK (board.told().at (before + 2).bytes == Bytes { 0, 0xaa, 0x01 });   // the init steps again
    count = 5000;
    CHECK (tickOn() < 0.2);
    double largest_step = 0.0, last = 0.0;
    for (int i = 0; i < 60; ++i)   // 30 ms of good readings, and the ramp
    {
        const double now = tickOn();
        largest_step = std::max (largest_step, now - last);
        last = now;
    }
    CHECK (last == 1.0);
    CHECK (largest_step < 0.21);
    CHECK (device->counts().lost == 0);   // counting starts again with the new connection
}

TEST_CASE ("an effort from before a device went away is never sent afterwards", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    tell (board, *device, boardReport (1));
    const Effort none {}, push { { 1.0, 0.0, 0.0 }, Vec3::Zero() };
    device->write (none);
    device->read();
    device->write (push);
    REQUIRE (eventually ([&] { return driven (board) > 0; }));

    board.plug (false);
    REQUIRE (eventually ([&] { return ! device->port().isConnected(); }));
    device->write (push);   // this effort is still on its way
    const auto before = driven (board);
    board.plug (true);
    REQUIRE (eventually ([&] { return device->port().isConnected(); }));
    device->write (push);
    for (int i = 0; i < 20; ++i)
    {
        tell (board, *device, boardReport (static_cast<std::uint16_t> (i)));
        device->write (push);   // a real guard would be at zero by now
    }
    CHECK (stays (5ms, [&] { return driven (board) == before; }));

    device->write (none);
    device->read();
    device->write (push);
    CHECK (eventually ([&] { return driven (board) > before; }));
}

TEST_CASE ("a device that the guardian has brought to rest is opened again, and starts from zero", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    tell (board, *device, boardReport (1));
    CHECK (board.beats() == 0);
    const Effort none {}, push { { 1.0, 0.0, 0.0 }, Vec3::Zero() };
    device->write (none);
    device->read();
    device->write (push);
    REQUIRE (eventually ([&] { return board.told().back().isDriven() && board.told().back().force (0) == 1000000; }));
    const auto beats = board.beats();
    CHECK (eventually ([&] { return board.beats() > beats + 5; }));   // they do not depend on the ticks

    const auto before = board.told().size();
    const auto driven_before = driven (board);
    board.take();
    device->write (push);   // the ticks continue as if nothing had happened
    REQUIRE (eventually ([&] { return board.openings() == 2 && device->port().isConnected(); }));
    const auto told = board.told();
    CHECK (told.at (before).isNeutral());
    const auto isInit = [] (const test::Told& t) { return t.bytes == Bytes { 0, 0xaa, 0x01 }; };
    CHECK (std::any_of (told.begin() + static_cast<std::ptrdiff_t> (before), told.end(), isInit));
    CHECK (device->port().counts().departures == 1);

    device->write (push);
    CHECK_FALSE (tell (board, *device, boardReport (2)).valid);   // so the guard must stop,
    device->write (push);                                         // but it is not at zero yet
    CHECK (stays (5ms, [&] { return driven (board) == driven_before; }));
    device->write (none);
    CHECK (tell (board, *device, boardReport (3)).valid);
    device->write (push);
    CHECK (eventually ([&] { return driven (board) > driven_before; }));
}

TEST_CASE ("a port without new efforts sends its device to rest, and later efforts start from zero", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board, { .watchdog = 0.1 });
    tell (board, *device, boardReport (1));
    const Effort none {}, push { { 1.0, 0.0, 0.0 }, Vec3::Zero() };
    double offered_s = 0.0;
    std::uint64_t silences = 0;
    REQUIRE (eventually ([&] {   // again if this thread did not run for so long that the port fell silent in between
        if (driven (board) > 0 && board.told().back().force (0) == 1'000'000) return true;
        device->write (none);
        device->read();
        silences = device->port().counts().silences;
        offered_s = board.watch.s();
        device->write (push);
        return false;
    }));
    REQUIRE (eventually ([&] { return device->port().counts().silences > silences && board.told().back().isNeutral(); }));
    CHECK (board.told().back().at_s - offered_s > 0.099);

    const auto before = driven (board);
    device->write (push);                                         // the ticks continue as before
    CHECK_FALSE (tell (board, *device, boardReport (2)).valid);   // so the guard must stop,
    device->write (push);                                         // but it is not at zero yet
    CHECK (stays (5ms, [&] { return driven (board) == before; }));
    device->write (none);
    CHECK (tell (board, *device, boardReport (3)).valid);
    device->write (push);
    CHECK (eventually ([&] { return driven (board) > before; }));
}

TEST_CASE ("neutral reports that the system does not take are sent again: after a silence, and on closing", "[hid][safety]")
{
    const bool closes = GENERATE (false, true);
    FakeBoard board;
    std::atomic<int> refused = 0;
    board.on_write = [&] (const Bytes& report) {   // the two reports that follow a force are not taken
        const bool pushes = report.size() == 25 && report[2] == 1 && report[5] != 0;
        refused = pushes ? 0 : refused + 1;
        board.failWrites (! pushes && refused <= 2);
    };
    auto device = openBoard (board, { .watchdog = closes ? 3600.0 : 0.1, .steps = "" });
    REQUIRE (eventually ([&] {
        tell (board, *device, boardReport (1));
        for (const double force : { 0.0, 1.0 })
        {
            device->read();
            device->write ({ { force, 0.0, 0.0 }, Vec3::Zero() });
        }
        return ! board.told().empty() && board.told().back().force (0) == 1'000'000;
    }));
    if (closes) device.reset();

    CHECK (eventually ([&] { return board.told().back().isNeutral(); }));   // without a tick
    if (closes) return;
    CHECK (device->port().counts().silences == 1);
    CHECK (device->port().counts().write_errors >= 2);
}

TEST_CASE ("a device that takes no neutral report when it is lost or closed is left to the guardian", "[hid][safety]")
{
    const bool closes = GENERATE (false, true), works = GENERATE (false, true);
    const TemporaryFolder folder;
    FakeBoard board;
    board.failsafe_file = (folder / "device").string();
    std::ofstream { board.failsafe_file }.close();
    const auto content = [&] {
        std::ifstream in (board.failsafe_file, std::ios::binary);
        return Bytes (std::istreambuf_iterator<char> (in), {});
    };
    auto device = openBoard (board, { .watchdog = 3600.0 });
    REQUIRE (eventually ([&] {   // again if the guardian took the board, because the writing thread did not run for so long
        tell (board, *device, boardReport (1));
        for (const double force : { 0.0, 1.0 })
        {
            device->read();
            device->write ({ { force, 0.0, 0.0 }, Vec3::Zero() });
        }
        return board.told().back().force (0) == 1'000'000;
    }));
    REQUIRE (content().empty());

    // A board that is unplugged cannot be written to, but one that is lost for another reason may still push.
    board.failWrites (! works);
    if (closes)
        device.reset();
    else
        board.failReads();

    Bytes neutral (25);
    neutral[1] = 0x54;
    if (works)
    {
        CHECK (eventually ([&] { return std::ranges::any_of (board.told(), &test::Told::isNeutral); }));
        if (! closes) CHECK (eventually ([&] { return board.openings() == 2; }));
        CHECK (stays (50ms, [&] { return content().empty(); }));
        return;
    }
    neutral.insert (neutral.end(), { 0, 0xaa, 0x03 });   // and the exit step
    CHECK (eventually ([&] { return content() == neutral; }));
}

TEST_CASE ("while a device is slow to take reports, only the latest effort is kept and sent", "[hid]")
{
    FakeBoard board;
    std::atomic<bool> slow = false, is_taking = false;
    board.on_write = [&] (const Bytes&) {
        for (; slow; test::letPass (100us))
            is_taking = true;
    };
    const auto device = openBoard (board);
    tell (board, *device, boardReport (1));
    device->write ({});
    REQUIRE (eventually ([&] { return driven (board) == 1; }));
    tell (board, *device, boardReport (2));

    slow = true;
    device->write ({ { 0.5, 0.0, 0.0 }, Vec3::Zero() });
    REQUIRE (eventually ([&] { return is_taking.load(); }));
    test::letPass (5ms);
    for (int i = 1; i <= 100; ++i)
        device->write ({ { 1e-3 * i, 0.0, 0.0 }, Vec3::Zero() });
    slow = false;
    REQUIRE (eventually ([&] { return driven (board) == 3; }));
    REQUIRE (stays (5ms, [&] { return driven (board) == 3; }));
    const auto told = board.told();
    CHECK (told[told.size() - 2].force (0) == 500'000);
    CHECK (told.back().force (0) == 100'000);
    CHECK (device->port().counts().dropped == 99);
    CHECK (device->port().counts().latency_max >= 5e-3);
}

TEST_CASE ("reports are sent no faster than the maximum rate, and repeated while nothing changes", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board, { .max_rate = 100.0, .keepalive = 0.03 });
    tell (board, *device, boardReport (1));
    device->write ({});
    const test::Stopwatch watch;
    for (int i = 0; ! watch.hasRun (100ms) || driven (board) < 5; ++i)
    {
        device->write ({ { 1e-5 * i, 0.0, 0.0 }, Vec3::Zero() });
        test::letPass (200us);
    }
    const auto busy = driven (board);
    CHECK (static_cast<double> (busy) <= 105.0 * watch.s() + 5.0);
    CHECK (eventually ([&] { return driven (board) >= busy + 2; }));
}

TEST_CASE ("a report that brings the device to rest waits neither for the maximum rate nor for the keepalive", "[hid]")
{
    const double keepalive = GENERATE (0.0, 3600.0);
    FakeBoard board;
    const auto device = openBoard (board, { .max_rate = 0.01, .keepalive = keepalive, .watchdog = 3600.0 });   // one report in 100 s
    tell (board, *device, boardReport (1));
    device->write ({});
    REQUIRE (eventually ([&] { return driven (board) == 1; }));
    for (std::size_t sent = 2; sent <= 5; ++sent)   // more than may be sent in a row
    {
        device->read();
        device->write ({ { 0.1 * static_cast<double> (sent), 0.0, 0.0 }, Vec3::Zero() });
        if (sent <= 4) REQUIRE (eventually ([&] { return driven (board) == sent; }));
    }
    REQUIRE (board.told().back().force (0) == 400'000);

    device->read();
    device->write ({});
    CHECK (eventually ([&] { return board.told().back().force (0) == 0; }));
    const auto sent = driven (board);
    for (int i = 0; i < 20; ++i)   // it rests, so the rate counts again
        device->write ({ { i % 2 == 0 ? 0.0 : 0.5, 0.0, 0.0 }, Vec3::Zero() });
    device->write ({});
    CHECK (stays (5ms, [&] { return driven (board) == sent; }));

    // After STOP, the guard's fade ends with such a report, too. A report that could not be sent is sent again.
    FakeBoard other;
    const auto stopped = openBoard (other, { .max_rate = 0.01, .keepalive = keepalive, .watchdog = 3600.0 });
    Driven run { *stopped, { .ramp = 0.0 } };
    tell (other, *stopped, boardReport (1));
    run.tick (0.0);
    REQUIRE (eventually ([&] { return driven (other) == 1; }));
    run.tick();
    REQUIRE (eventually ([&] { return other.told().back().force (0) == 1'000'000; }));
    other.failWrites (true);
    run.guard.emergencyStop();
    for (int i = 0; i < 10; ++i)
        run.tick();
    CHECK (run.guard.isAtRest());
    REQUIRE (eventually ([&] { return stopped->port().counts().write_errors > 10; }));
    other.failWrites (false);
    CHECK (eventually ([&] { return other.told().back().force (0) == 0; }));
}

TEST_CASE ("an effort is sent as soon as it is written, whichever clock drives the run", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board, { .max_rate = 0.01, .watchdog = 3600.0 });   // unless it is woken, the writing thread looks every 50 s
    tell (board, *device, boardReport (1));
    for (std::size_t sent = 1; sent <= 3; ++sent)
    {
        device->write ({});
        CHECK (eventually ([&] { return driven (board) == sent; }));
    }
}

TEST_CASE ("failed writes are counted and reported, and later writes still work", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    tell (board, *device, boardReport (1));
    board.failWrites (true);
    device->write ({});
    REQUIRE (eventually ([&] { return device->port().counts().write_errors > 0; }));
    CHECK (device->port().trouble() == "Input/output error");
    CHECK (device->port().isConnected());
    board.failWrites (false);
    device->read();
    device->write ({});
    CHECK (eventually ([&] { return driven (board) > 0; }));
}

TEST_CASE ("a reading ages when the ring overflows, however many old reports it holds", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    tell (board, *device, boardReport (0));
    constexpr std::uint16_t room = 1024;
    for (std::uint16_t i = 1; i <= room + 36; ++i)
        deliver (board, *device, boardReport (i));
    CHECK (device->read().age > 0.0);
    CHECK (device->port().counts().overflown == 36);
    CHECK (tell (board, *device, boardReport (room + 39)).age == 0.0);
    CHECK (device->counts().lost == 2);   // lost by the device; the other reports arrived but did not fit
}

TEST_CASE ("reading and driving a device neither allocates nor locks, and only wakes the writing thread", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    for (std::uint16_t i = 1; i <= 20; ++i)
        deliver (board, *device, boardReport (i, i));
    {
        const NoAllocation watch;
        for (int i = 0; i < 100; ++i)
        {
            device->read();
            device->write ({ { 0.0, 0.0, i > 50 ? 1e-3 * i : 0.0 }, Vec3::Zero() });
        }
        CHECK (watch.allocations() == 0);
        CHECK (watch.locks() == 0);
    }
    if (! test::canForbidSystemCalls()) return;
    const auto end = test::inChild ([&] {
        test::forbidSystemCalls (test::Allow::waking_threads);
        for (int i = 0; i < 100; ++i)
        {
            device->read();
            device->write ({});
        }
        return 3;
    });
    CHECK (end.signal == 0);
    CHECK (end.status == 3);
}
