// SPDX-License-Identifier: MIT
// A device on each wire, pushed for a while: each report is answered once, in order, and after a stop nothing pushes. TACTUS_SOAK_SECONDS is the length
// of each run in s of the device's time, 1000 reports each; without it, 60 (fewer under a sanitizer).
//
// The device's clock goes on by 1 ms with each report, and the next report comes as soon as the last one is answered. So this shows that no report is lost,
// doubled, changed or taken out of order, however many pass; it takes the wire and all threads of the port, and no pause of a real minute. It says
// nothing about time: wire_time_test, wires_test and the bench do. A busy computer may stand still for 5 ms within a report on a serial line, which drops
// what has come of it, as on a real line. Such a report is counted, and the next one has to be in order again.

#include "support/rounds.hpp"
#include "support/waiting.hpp"
#include "wire_bench.hpp"

#include <host/devices/hid_link/open_device.hpp>
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <string>

using namespace tactus;
using namespace tactus::test::wires;

namespace
{
bool pushes (const Bytes& report) { return numberAt (report, 8) != 0 || numberAt (report, 12) != 0 || numberAt (report, 16) != 0; }

/// Ticks a guard on the bench, with a push that turns round, and checks each answer as it comes. Keeps no list, so that a long run needs no more memory.
struct Soak
{
    explicit Soak (Bench& b) : bench (b)
    {
        guard.prepare (limitsOf (*bench.profile, {}), 1e-3, bench.device->layout());
        bench.device->port().readHere();   // this thread sleeps until a report is there, as the tick thread of a run on this device does
        bench.fake->on_line = [this] (const FakeDevice::Line& line) {
            if (line.what == FakeDevice::Line::What::released) ++released;
            if (line.what == FakeDevice::Line::What::sent) sent = Bytes (line.bytes.begin(), line.bytes.end());
            if (line.what != FakeDevice::Line::What::heard) return;
            ++heard;
            answer = Bytes (line.bytes.begin(), line.bytes.end());
            const auto number = numberAt (answer, 4);
            disordered += number < echoed ? 1 : 0;
            echoed = number;
            pushing += pushes (answer) ? 1 : 0;
        };
    }

    ~Soak() { giveBack(); }
    Soak (const Soak&) = delete;
    Soak& operator= (const Soak&) = delete;

    /// What has come and gone, for a soak that fails.
    std::string account() const
    {
        const auto port = bench.device->port().counts();
        const auto fake = bench.fake->counts();
        const auto number = [] (auto n) { return std::to_string (n); };
        return "sent " + number (fake.sent) + ", the last is " + number (numberAt (sent, 4)) + "; read " + number (port.reports) + ": "
               + describe (bench.device->counts(), port) + "; written " + number (port.writes) + ", not accepted " + number (port.write_errors) + ", replaced "
               + number (port.dropped) + ", silences " + number (port.silences) + "; heard " + number (fake.heard) + ", the last answers " + number (echoed)
               + ", refused " + number (fake.refused) + ", stray bytes " + number (fake.stray) + "; in all " + number (cut) + " cut, "
               + number (unheard) + " unheard";
    }

    /// Ends the reading on this thread, as the device cannot be closed before.
    void giveBack() const noexcept
    {
        if (bench.device) bench.device->port().readElsewhere();
    }

    /// One report and its answer. False if the device is gone, or an answer is not that to this report.
    bool tick()
    {
        bench.fake->step();
        bench.system.ns += 1'000'000;
        const double number = numberAt (sent, 4);
        Reading reading;
        auto& port = bench.device->port();
        const bool arrived = eventually (0ms, [&] {
            reading = bench.device->read();
            return bench.device->model().sample().axes[bench.sequence] == number || (port.waitForReport (fromNow (10ms)), false);
        });
        if (! arrived)
        {
            ++cut;
            ++ticks;
            return port.isConnected();
        }
        const auto before = heard, stray = bench.fake->counts().stray;
        const double push = 0.5 * static_cast<double> (static_cast<int> (ticks++ % 200) - 100) / 100.0;
        bench.device->write (guard ({ .force = { push, 0.0, push } }, reading));
        const bool answered = eventually (0ms, [&] {
            bench.fake->hear (fromNow (10ms));
            return heard != before;
        });
        if (! answered)
        {
            ++unheard;
            return bench.fake->counts().stray != stray;   // otherwise, nothing on the line explains it
        }
        return echoed == numberAt (sent, 4);
    }

    Bench& bench;
    Guard guard;
    Bytes sent, answer;
    std::uint64_t ticks = 0, heard = 0, pushing = 0, disordered = 0, released = 0;
    std::uint64_t cut = 0, unheard = 0;   // reports and answers of which a pause has dropped a part
    std::uint32_t echoed = 0;
};

/// Each report is answered once and in order, and nothing pushes after a stop.
void soakOver (Wire wire, const char* framing)
{
    Bench bench { wire, board (framing, "600 s", 5ms) };   // a disk may hold up a program for longer than any watchdog
    Soak soak { bench };
    REQUIRE (soak.tick());   // with what came while the device was opened
    const auto before = bench.device->counts();
    const auto all = test::soakReports();
    while (soak.ticks < all)
        if (! soak.tick())
        {
            INFO ("tick " << soak.ticks << ", trouble: " << bench.device->port().trouble() << "\n"
                          << soak.account());
            FAIL();
        }

    INFO (soak.account());
    const auto n = bench.device->counts();
    const auto port = bench.device->port().counts();
    CHECK (soak.heard + soak.cut + soak.unheard == soak.ticks);
    CHECK (1000 * (soak.cut + soak.unheard) <= soak.ticks);
    CHECK (soak.disordered == 0);
    CHECK (soak.pushing > soak.ticks / 2);
    CHECK (n.lost - before.lost <= soak.cut);
    CHECK (n.restarts == 0);
    for (const auto refused : n.refused)
        CHECK (refused == 0);
    CHECK (port.dropped == 0);
    CHECK (port.write_errors == 0);
    CHECK (port.overflown == 0);
    CHECK (port.departures == 0);
    CHECK (bench.fake->counts().refused == 0);
    if (soak.unheard == 0) CHECK (bench.fake->counts().stray == 0);
    CHECK (soak.released == 0);
    if (std::getenv ("TACTUS_SOAK_SECONDS") != nullptr)
        std::cout << (wire == Wire::udp ? "UDP" : framing) << ": " << soak.ticks << " reports, " << soak.heard << " answers in their order, "
                  << soak.cut + soak.unheard << " dropped in a pause of the line\n";

    // A stop: once the guard has faded the force out, no report pushes.
    soak.guard.emergencyStop();
    for (int k = 0; k < 20; ++k)
        REQUIRE (soak.tick());
    const auto pushing = soak.pushing;
    for (int k = 0; k < 200; ++k)
        REQUIRE (soak.tick());
    CHECK (soak.pushing == pushing);
    soak.giveBack();
    bench.device.reset();
    while (bench.fake->hear (fromNow (100ms)))
        ;
    CHECK_FALSE (pushes (soak.answer));
    CHECK ((soak.answer[2] & 1u) == 0);   // the motors are off
}
}   // namespace

TEST_CASE ("a long run over a serial line with COBS: each report is answered once and in order, and nothing pushes after a stop", "[wires][hid][soak]")
{
    soakOver (Wire::serial, "cobs");
}

TEST_CASE ("a long run over a serial line with lengths: each report is answered once and in order, and nothing pushes after a stop", "[wires][hid][soak]")
{
    soakOver (Wire::serial, "length");
}

TEST_CASE ("a long run over a serial line without frames: each report is answered once and in order, and nothing pushes after a stop", "[wires][hid][soak]")
{
    soakOver (Wire::serial, "none");
}

TEST_CASE ("a long run over UDP: each report is answered once and in order, and nothing pushes after a stop", "[wires][hid][soak]")
{
    soakOver (Wire::udp, "cobs");
}
