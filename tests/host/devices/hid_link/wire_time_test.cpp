// SPDX-License-Identifier: MIT
// The limits of a device hold on the wire per second of wall time, whatever drives the run, and however fast it ticks.

#include "fake_board.hpp"

#include <support/property.hpp>
#include <tactus/run/clock/passed_time.hpp>
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <optional>

using namespace tactus;
using test::boardReport;
using test::eventually;
using test::FakeBoard;

namespace
{
constexpr double dt = 1e-3, slew = 100.0;

/// Ticks a board with a profile of 1 kHz in virtual time.
struct Bench
{
    explicit Bench (double slew_of_session = slew)
    {
        board.virtual_ns = 1'000'000'000;
        device = openBoard (board, { .ramp = 0.0, .max_slew = slew });
        guard.prepare ({ .max_force = 3.0, .max_slew = slew_of_session }, dt);
        device->limitSlews (slew_of_session, GuardLimits::none, GuardLimits::none);
    }

    /// A tick, this long after the last one. Returns the force on the wire in N. Without `counts`, the guard believes that a period has passed.
    double tick (double after_s, double wanted, bool counts)
    {
        board.virtual_ns += static_cast<std::int64_t> (1e9 * after_s);
        const auto before = device->port().counts().reports;
        board.send (boardReport (++number));
        REQUIRE (eventually ([&] { return device->port().counts().reports > before; }));
        const auto reading = device->read();
        const double passed = passed_time (1e-9 * static_cast<double> (board.virtual_ns), 0.0);
        device->write (guard ({ .force = { wanted, 0, 0 } }, reading, counts ? passed : dt));
        return device->effortsNow()[0];
    }

    FakeBoard board;
    std::unique_ptr<host::hid::HidDevice> device;
    Guard guard;
    PassedTime passed_time { dt };
    std::uint16_t number = 0;
};
}   // namespace

TEST_CASE ("on the wire, no force changes faster than the slew per second of wall time", "[hid][safety]")
{
    for (const bool counts : { true, false })
        test::property (counts ? "at any rate of ticks" : "even if the run does not count its time", [&] {
            Bench b;
            b.tick (dt, 0.0, counts);
            double last = b.tick (dt, 0.0, counts);
            for (int k = 0; k < 60; ++k)
            {
                const double after = dt * *rc::gen::element (0.0, 0.05, 0.125, 0.125, 0.125, 1.0, 1.3, 5.0), wanted = *rc::gen::element (3.0, 3.0, 3.0, -3.0);
                const double now = b.tick (after, wanted, counts);
                RC_ASSERT (std::abs (now - last) <= slew * after + 1e-9);
                last = now;
            }
        });

    SECTION ("a device at 8 kHz under a profile of 1 kHz gains nothing, and loses nothing")
    {
        for (const bool counts : { true, false })
        {
            Bench b;
            b.tick (dt, 0.0, counts);
            double force = 0.0;
            for (int k = 0; k < 8 * 20; ++k)
                force = b.tick (dt / 8.0, 3.0, counts);
            CHECK (force == Approx (slew * 20.0 * dt).epsilon (0.05));
        }
    }
}

TEST_CASE ("a slew limit of the session or the graph holds on the wire per second, also after a pause", "[hid][safety]")
{
    constexpr double strict = 10.0;
    Bench b (strict);
    b.tick (dt, 0.0, true);
    b.tick (dt, 0.0, true);
    double last = b.tick (19.0 * dt, 3.0, true);
    for (int k = 0; k < 40; ++k)
    {
        const double now = b.tick (dt / 8.0, 3.0, true);
        CHECK (now - last <= strict * dt / 8.0 + 1e-9);
        CHECK (now > last);
        last = now;
    }
}

TEST_CASE ("the age of a reading is real, however fast or slowly the run ticks", "[hid][safety]")
{
    for (const double period : { dt / 8.0, dt, 10.0 * dt })
    {
        CAPTURE (period);
        Bench b;
        b.tick (dt, 0.0, true);
        const auto heard = b.board.virtual_ns.load();
        for (int k = 0; k < 20; ++k)
        {
            b.board.virtual_ns += static_cast<std::int64_t> (1e9 * period);
            CHECK (b.device->read().age >= 1e-9 * static_cast<double> (b.board.virtual_ns - heard) - 1e-12);
        }
    }
}
