// SPDX-License-Identifier: MIT
// A device on each wire, pushed for a while: each report is answered once, in order, and after a stop nothing pushes. TACTUS_SOAK_SECONDS is the length
// of each run in s of the device's time, 1000 reports each; without it, 3.

#include "wire_bench.hpp"

#include <host/hid_link/open_device.hpp>
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <string>

using namespace tactus;
using namespace tactus::test::wires;

namespace
{
std::uint64_t soakTicks()
{
    const auto* wanted = std::getenv ("TACTUS_SOAK_SECONDS");
    return static_cast<std::uint64_t> (1000.0 * (wanted != nullptr ? std::max (1.0, std::atof (wanted)) : 3.0));
}

bool pushes (const Bytes& report) { return numberAt (report, 8) != 0 || numberAt (report, 12) != 0 || numberAt (report, 16) != 0; }

/// Ticks a guard on the bench, with a push that turns round, and checks each answer as it comes. Keeps no list, so that a long run needs no more memory.
struct Soak
{
    explicit Soak (Bench& b) : bench (b)
    {
        guard.prepare (limitsOf (*bench.profile, {}), 1e-3, bench.device->layout());
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

    /// One report and its answer. False if one of them does not come.
    bool tick()
    {
        bench.fake->step();
        bench.system.ns += 1'000'000;
        const double number = numberAt (sent, 4);
        Reading reading;
        const auto end = WireClock::now() + 10s;
        do
        {
            if (WireClock::now() > end) return false;
            reading = bench.device->read();
        } while (bench.device->model().sample().axes[bench.sequence] != number);
        const auto before = heard;
        const double push = 0.5 * static_cast<double> (static_cast<int> (ticks++ % 200) - 100) / 100.0;
        bench.device->write (guard ({ .force = { push, 0.0, push } }, reading));
        while (heard == before)
            if (! bench.fake->hear (WireClock::now() + 10ms) && WireClock::now() > end) return false;
        return echoed == numberAt (sent, 4);
    }

    Bench& bench;
    Guard guard;
    Bytes sent, answer;
    std::uint64_t ticks = 0, heard = 0, pushing = 0, disordered = 0, released = 0;
    std::uint32_t echoed = 0;
};
}   // namespace

TEST_CASE ("a long run over a wire: each report is answered once and in order, and nothing pushes after a stop", "[wires][hid][soak]")
{
    struct Way
    {
        Wire wire;
        const char* framing;
    };
    const auto way = GENERATE (Way { Wire::serial, "cobs" }, Way { Wire::serial, "length" }, Way { Wire::serial, "none" }, Way { Wire::udp, "cobs" });
    const auto all = soakTicks();
    for (std::uint64_t done = 0; done < all;)
    {
        Bench bench { way.wire, board (way.framing) };
        Soak soak { bench };
        while (done + soak.ticks < all && soak.tick())
            ;
        // If the computer stood still for a second, the port takes it for suspended and opens the device again; then the soak goes on with a new one.
        const auto trouble = bench.device->port().trouble();
        const bool was_suspended = trouble.find ("suspended") != std::string::npos;
        INFO ("wire " << static_cast<int> (way.wire) << ", framing " << way.framing << ", tick " << done + soak.ticks << ", trouble: " << trouble);
        REQUIRE ((was_suspended || done + soak.ticks == all));
        done += soak.ticks;
        if (was_suspended) continue;

        const auto n = bench.device->counts();
        const auto port = bench.device->port().counts();
        CHECK (soak.heard == soak.ticks);
        CHECK (soak.disordered == 0);
        CHECK (soak.pushing > soak.ticks / 2);
        CHECK (n.lost == 0);
        CHECK (n.restarts == 0);
        for (const auto refused : n.refused)
            CHECK (refused == 0);
        CHECK (port.dropped == 0);
        CHECK (port.write_errors == 0);
        CHECK (port.overflown == 0);
        CHECK (bench.fake->counts().refused == 0);
        CHECK (bench.fake->counts().stray == 0);
        CHECK (soak.released == 0);

        // A stop: once the guard has faded the force out, no report pushes.
        soak.guard.emergencyStop();
        for (int k = 0; k < 20; ++k)
            REQUIRE (soak.tick());
        const auto pushing = soak.pushing;
        for (int k = 0; k < 200; ++k)
            REQUIRE (soak.tick());
        CHECK (soak.pushing == pushing);
        bench.device.reset();
        while (bench.fake->hear (WireClock::now() + 100ms))
            ;
        CHECK_FALSE (pushes (soak.answer));
        CHECK ((soak.answer[2] & 1u) == 0);   // the motors are off
    }
}
