// SPDX-License-Identifier: MIT
// The same as wire_soak_test, over HID. A pair of sockets takes the place of the system's file of reports. The port, its threads and the reading by the
// tick are those of a real device. The guest (tests/guest) tests hidapi and the kernel.

#include "fake_board.hpp"
#include "socket_board.hpp"
#include "support/rounds.hpp"
#include "support/waiting.hpp"

#include <host/devices/hid_link/open_device.hpp>
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#if defined(__linux__)

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

    test::Told hear (std::chrono::milliseconds longest) const { return { board.hear (longest), test::Told::How::output, {} }; }

    /// One report, whose sequence number wraps after 65 536, and its answer. False if the report is not read, or an answer is not that to this report.
    bool tick()
    {
        const auto number = static_cast<std::uint16_t> (++ticks);
        const auto depth = static_cast<std::int32_t> (ticks % 2'000'000);   // nm
        if (! board.send (test::boardReport (number, depth, 0, -depth))) return false;
        Reading reading;
        const bool arrived = test::eventually (0ms, [&] { return device->port().counts().reports >= ticks || (device->port().waitForReport (test::fromNow (10ms)), false); });
        if (! arrived) return false;
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
    const auto all = test::soakReports();
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
