// SPDX-License-Identifier: MIT
// The same as wire_soak_test for HID: a device at the far end of a pair of sockets, which stands for the system's file of reports, is pushed for a while.
// The port, its threads and the reading by the tick are those of a real device; hidapi and the kernel are tested in the guest (tests/guest).

#include "fake_board.hpp"
#include "socket_board.hpp"
#include "support/rounds.hpp"

#include <host/hid_link/open_device.hpp>
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#if defined(__linux__)

#include <poll.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <memory>
#include <string>

using namespace tactus;
using namespace tactus::host::hid;
using namespace std::chrono_literals;

namespace
{
using Clock = std::chrono::steady_clock;

std::uint64_t soakTicks()
{
    const auto* wanted = std::getenv ("TACTUS_SOAK_SECONDS");
    return wanted != nullptr ? static_cast<std::uint64_t> (1000.0 * std::max (1.0, std::strtod (wanted, nullptr))) : test::rounds (60'000ull);
}

/// A guard ticks on the device, with a push that turns round. Each answer is checked as it comes.
struct HidSoak
{
    HidSoak()
    {
        auto opened = HidPort::open (board, {}, profile, { .look_again = 1h, .real_time = false });
        REQUIRE (opened);
        device = std::make_unique<HidDevice> (std::move (*opened));
        device->prepare (1e-3);
        guard.prepare (limitsOf (*profile, {}), 1e-3, device->layout());
        device->port().readHere();   // as the tick thread of a run on this device does
    }

    ~HidSoak() { close(); }
    HidSoak (const HidSoak&) = delete;
    HidSoak& operator= (const HidSoak&) = delete;

    void close()
    {
        if (! device) return;
        device->port().readElsewhere();
        device.reset();
    }

    /// The next report that the board gets. Empty: none within this time.
    test::Told hear (std::chrono::milliseconds longest) const
    {
        pollfd polled { .fd = board.end, .events = POLLIN, .revents = 0 };
        Bytes bytes (65);
        if (::poll (&polled, 1, static_cast<int> (longest.count())) <= 0) return {};
        bytes.resize (static_cast<std::size_t> (std::max<ssize_t> (0, ::read (board.end, bytes.data(), bytes.size()))));
        return { bytes, test::Told::How::output, {} };
    }

    /// One report, whose sequence number wraps after 65 536, and its answer. False if the report is not read, or an answer is not that to this report.
    bool tick()
    {
        const auto number = static_cast<std::uint16_t> (++ticks);
        const auto depth = static_cast<std::int32_t> (ticks % 2'000'000);   // nm
        if (! board.send (test::boardReport (number, depth, 0, -depth))) return false;
        Reading reading;
        for (const auto end = Clock::now() + 1min; device->port().counts().reports < ticks;)
            if (! device->port().waitForReport (Clock::now() + 10ms) && Clock::now() > end) return false;
        reading = device->read();
        moved += reading.position.x() == 1e-9 * depth && reading.position.z() == -1e-9 * depth ? 1 : 0;
        const double push = 0.5 * static_cast<double> (static_cast<int> (ticks % 200) - 100) / 100.0;
        device->write (guard ({ .force = { push, 0.0, push } }, reading));
        const auto told = hear (60s);
        if (! told.isEffort() || told.echo() != number) return false;
        pushing += told.force (0) != 0 || told.force (1) != 0 || told.force (2) != 0 ? 1 : 0;
        return true;
    }

    // A disk may hold up a program for longer than any watchdog.
    std::shared_ptr<const Profile> profile = test::BoardProfile { .max_rate = 20000.0, .watchdog = 600.0, .steps = "" }.make();
    test::SocketBoard board;
    std::unique_ptr<HidDevice> device;
    Guard guard;
    std::uint64_t ticks = 0, moved = 0, pushing = 0;
};
}   // namespace

TEST_CASE ("a long run over HID: each report is answered once and in order, and nothing pushes after a stop", "[hid][wires][soak]")
{
    HidSoak soak;
    const auto all = soakTicks();
    while (soak.ticks < all)
    {
        const bool answered = soak.tick();
        INFO ("report " << soak.ticks << ", trouble: " << soak.device->port().trouble());
        REQUIRE (answered);
    }

    const auto n = soak.device->counts();
    const auto port = soak.device->port().counts();
    CHECK (soak.moved == soak.ticks);
    CHECK (soak.pushing > soak.ticks / 2);
    CHECK (n.lost == 0);
    CHECK (n.restarts == 0);
    for (const auto refused : n.refused)
        CHECK (refused == 0);
    CHECK (port.reports == soak.ticks);
    CHECK (port.dropped == 0);
    CHECK (port.write_errors == 0);
    CHECK (port.overflown == 0);
    CHECK (port.departures == 0);
    CHECK (port.silences == 0);
    CHECK (soak.hear (0ms).bytes.empty());   // no second answer
    if (std::getenv ("TACTUS_SOAK_SECONDS") != nullptr) std::cout << "HID: " << soak.ticks << " reports, as many answers in their order\n";

    // A stop: once the guard has faded the force out, no report pushes.
    soak.guard.emergencyStop();
    for (int k = 0; k < 20; ++k)
        REQUIRE (soak.tick());
    const auto pushing = soak.pushing;
    for (int k = 0; k < 200; ++k)
        REQUIRE (soak.tick());
    CHECK (soak.pushing == pushing);

    soak.close();
    const auto last = soak.hear (1s);
    CHECK (last.isNeutral());   // the motors are off
    CHECK (last.force (0) == 0);
}

#endif
