// SPDX-License-Identifier: MIT
// A HID device in a run, on a wire that can be cut: what comes in, what is sent, and when nothing must be.

#include "fake_board.hpp"

#include "support/no_allocation.hpp"
#include "support/no_system_calls.hpp"

#include <framework/guard.hpp>

#include <catch2/catch.hpp>

using namespace tactus;
using namespace tactus::host::hid;
using test::boardReport;
using test::Bytes;
using test::FakeBoard;
using test::openBoard;
using namespace std::chrono_literals;

namespace
{
/// Sends, and waits until the port has it.
void deliver (FakeBoard& board, HidDevice& device, Bytes report)
{
    const auto before = device.port().counts().reports;
    board.send (std::move (report));
    REQUIRE (board.until ([&]
                          { return device.port().counts().reports > before; }));
}

Reading tell (FakeBoard& board, HidDevice& device, Bytes report)
{
    deliver (board, device, std::move (report));
    return device.read();
}

/// A device with its guard, as an engine has them, and a hand that pulls for all it is worth.
struct Driven
{
    explicit Driven (HidDevice& d, const GuardLimits& limits = {}) : device (d) { guard.prepare (limits, 1e-3); }

    Effort tick (double wanted = 1.0)
    {
        reading = device.read();
        const auto effort = guard ({ { wanted, 0.0, 0.0 }, Vec3::Zero() }, reading);
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

TEST_CASE ("what a device is told on opening and on closing stands in its profile", "[hid]")
{
    FakeBoard board;
    openBoard (board).reset();
    const auto told = board.told();
    REQUIRE (told.size() == 6);
    CHECK (told[0].how == test::Told::How::will);   // before anything else, the neutral report and the exit
    CHECK (told[0].bytes.at (1) == 0x54);
    CHECK (told[1].how == test::Told::How::will);
    CHECK (told[1].bytes == Bytes { 0, 0xaa, 0x03 });
    CHECK (told[2].bytes == Bytes { 0, 0xaa, 0x01 });
    CHECK (told[3].bytes == Bytes { 0, 0xaa, 0x02 });
    CHECK (told[3].how == test::Told::How::feature);
    CHECK (told[4].isNeutral());
    CHECK (told[5].bytes == Bytes { 0, 0xaa, 0x03 });
}

TEST_CASE ("reports that are no good change no value, stop the reading and are counted by what is wrong with them", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    Driven run { *device };
    run.tick();
    CHECK_FALSE (run.reading.valid);   // nothing has come

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
    CHECK (counts.lost == 1);   // number 2, which was sent with a wrong mark
    CHECK (counts.refused[static_cast<std::size_t> (Refusal::wrong_mark)] == 1);
    CHECK (counts.refused[static_cast<std::size_t> (Refusal::too_short)] == 1);
    CHECK (counts.refused[static_cast<std::size_t> (Refusal::too_long)] == 2);
}

TEST_CASE ("sequence numbers tell what was lost and what came out of order, also around their end", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    for (const int count : { 65533, 65534, 1, 2, 0, 3 })   // 65535 and 0 are lost, 0 comes late, 1 and 2 are taken for lost then
        deliver (board, *device, boardReport (static_cast<std::uint16_t> (count)));
    device->read();
    CHECK (device->counts().lost == 4);
    CHECK (device->counts().restarts == 1);
    CHECK (device->counts().taken == 6);
    CHECK (device->counts().skipped == 5);   // one tick looked at all of them
}

TEST_CASE ("a device that falls silent under force is without force within its watchdog", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    const GuardLimits limits { .ramp = 0.01, .watchdog = 0.02 };
    Driven run { *device, limits };
    std::uint16_t count = 0;
    for (int i = 0; i < 30; ++i)
    {
        deliver (board, *device, boardReport (++count));
        run.tick();
    }
    REQUIRE (run.tick().force.x() == 1.0);

    int ticks = 1;
    while (run.tick().force.x() > 0.0 && ticks < 100)
        ++ticks;
    CHECK (ticks <= 20 + 5 + 1);   // the watchdog, and the guard's way down
    CHECK (run.guard.stop() == Guard::Stop::stale);
    CHECK (run.reading.age > 0.02);

    deliver (board, *device, boardReport (++count));
    CHECK (run.tick().force.x() < 0.2);   // and rises as the ramp has it
}

TEST_CASE ("a device unplugged under force is told to rest, and driven again from zero when it is back", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    Driven run { *device, { .ramp = 0.01, .watchdog = 0.02 } };
    std::uint16_t count = 0;
    const auto tickOn = [&]
    {
        deliver (board, *device, boardReport (++count));
        return run.tick().force.x();
    };
    for (int i = 0; i < 20; ++i)
        tickOn();
    REQUIRE (tickOn() == 1.0);

    board.plug (false);
    REQUIRE (board.until ([&]
                          { return ! device->port().isConnected(); }));
    run.tick();
    CHECK_FALSE (run.reading.valid);
    for (int i = 0; i < 20; ++i)
        run.tick();
    CHECK (run.guard.isAtRest());
    const auto before = board.told().size();

    // It comes back as another file, as devices do.
    board.what.path = "fake/1";
    board.plug (true);
    REQUIRE (board.until ([&]
                          { return device->port().isConnected(); }));
    CHECK (board.openings() == 2);
    CHECK (device->port().counts().departures == 1);
    CHECK (board.told().at (before + 2).bytes == Bytes { 0, 0xaa, 0x01 });   // the init again
    count = 5000;
    CHECK (tickOn() < 0.2);
    double largest_step = 0.0, last = 0.0;
    for (int i = 0; i < 30; ++i)
    {
        const double now = tickOn();
        largest_step = std::max (largest_step, now - last);
        last = now;
    }
    CHECK (last == 1.0);
    CHECK (largest_step < 0.21);
    CHECK (device->counts().lost == 0);   // another connection counts anew
}

TEST_CASE ("an effort from before a device went away never reaches it afterwards", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    tell (board, *device, boardReport (1));
    const Effort none {}, push { { 1.0, 0.0, 0.0 }, Vec3::Zero() };
    device->write (none);
    device->read();
    device->write (push);
    REQUIRE (board.until ([&]
                          { return driven (board) > 0; }));

    board.plug (false);
    REQUIRE (board.until ([&]
                          { return ! device->port().isConnected(); }));
    device->write (push);   // it was on its way
    const auto before = driven (board);
    board.plug (true);
    REQUIRE (board.until ([&]
                          { return device->port().isConnected(); }));
    device->write (push);
    for (int i = 0; i < 20; ++i)
    {
        tell (board, *device, boardReport (static_cast<std::uint16_t> (i)));
        device->write (push);   // a guard would be at zero by now
    }
    std::this_thread::sleep_for (5ms);
    CHECK (driven (board) == before);

    device->write (none);
    device->read();
    device->write (push);
    CHECK (board.until ([&]
                        { return driven (board) > before; }));
}

TEST_CASE ("a port that is given no more efforts lets its device rest, and what comes later begins at zero", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board, { .watchdog = 0.1 });
    tell (board, *device, boardReport (1));
    const Effort none {}, push { { 1.0, 0.0, 0.0 }, Vec3::Zero() };
    device->write (none);
    device->read();
    const auto offered = std::chrono::steady_clock::now();
    device->write (push);
    REQUIRE (board.until ([&]
                          { return driven (board) > 0 && device->port().counts().silences == 1; }));
    const auto told = board.told();
    CHECK (told.back().isNeutral());
    CHECK (told.back().at - offered > 99ms);

    const auto before = driven (board);
    device->write (push);                                         // the ticks go on where they were
    CHECK_FALSE (tell (board, *device, boardReport (2)).valid);   // the guard is to stop,
    device->write (push);                                         // but is not at zero yet
    std::this_thread::sleep_for (5ms);
    CHECK (driven (board) == before);
    device->write (none);
    CHECK (tell (board, *device, boardReport (3)).valid);
    device->write (push);
    CHECK (board.until ([&]
                        { return driven (board) > before; }));
}

TEST_CASE ("of what is offered while a device is slow to listen only the latest is sent", "[hid]")
{
    FakeBoard board;
    std::atomic<bool> slow = false;
    board.on_write = [&] (const Bytes&)
    {
        while (slow)
            std::this_thread::sleep_for (100us);
    };
    const auto device = openBoard (board, { .watchdog = 10.0 });
    tell (board, *device, boardReport (1));
    device->write ({});
    REQUIRE (board.until ([&]
                          { return driven (board) == 1; }));
    tell (board, *device, boardReport (2));

    slow = true;
    device->write ({ { 0.5, 0.0, 0.0 }, Vec3::Zero() });
    device->port().kick();
    std::this_thread::sleep_for (5ms);   // it is on its way
    for (int i = 1; i <= 100; ++i)
        device->write ({ { 1e-3 * i, 0.0, 0.0 }, Vec3::Zero() });
    slow = false;
    REQUIRE (board.until ([&]
                          { return driven (board) == 3; }));
    std::this_thread::sleep_for (5ms);
    const auto told = board.told();
    REQUIRE (driven (board) == 3);
    CHECK (told[told.size() - 2].force (0) == 500'000);
    CHECK (told.back().force (0) == 100'000);
    CHECK (device->port().counts().dropped == 99);
    CHECK (device->port().counts().latency_max >= 5e-3);
}

TEST_CASE ("reports are not sent faster than a device takes them, but again while nothing changes", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board, { .max_rate = 100.0, .keepalive = 0.03, .watchdog = 10.0 });
    tell (board, *device, boardReport (1));
    device->write ({});
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; std::chrono::steady_clock::now() - begin < 100ms; ++i)
    {
        device->write ({ { 1e-5 * i, 0.0, 0.0 }, Vec3::Zero() });
        std::this_thread::sleep_for (200us);
    }
    const double took = std::chrono::duration<double> (std::chrono::steady_clock::now() - begin).count();
    const auto busy = driven (board);
    CHECK (static_cast<double> (busy) <= 105.0 * took + 5.0);
    CHECK (busy >= 5);
    CHECK (board.until ([&]
                        { return driven (board) >= busy + 2; }));
}

TEST_CASE ("writes that the system does not take are counted, told, and do not keep later ones away", "[hid]")
{
    FakeBoard board;
    const auto device = openBoard (board);
    tell (board, *device, boardReport (1));
    board.failWrites (true);
    device->write ({});
    REQUIRE (board.until ([&]
                          { return device->port().counts().write_errors > 0; }));
    CHECK (device->port().trouble() == "Input/output error");
    CHECK (device->port().isConnected());
    board.failWrites (false);
    device->read();
    device->write ({});
    CHECK (board.until ([&]
                        { return driven (board) > 0; }));
}

TEST_CASE ("a reading grows old when the reader found no room, however many old reports there are to take", "[hid]")
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
    CHECK (device->counts().lost == 2);   // by the device; the others were there
}

TEST_CASE ("reading and driving a device neither allocates nor locks nor calls the system", "[hid]")
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
    const auto end = test::inChild ([&]
                                    {
        test::forbidSystemCalls();
        for (int i = 0; i < 100; ++i)
        {
            device->read();
            device->write ({});
        }
        return 3; });
    CHECK (end.signal == 0);
    CHECK (end.status == 3);
}
