// SPDX-License-Identifier: MIT
// A board that sends good-looking reports that cannot be trusted, under force: when the force is gone, why, and when it returns.

#include "fake_board.hpp"

#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>

using namespace tactus;
using namespace tactus::host::hid;
using test::boardReport;
using test::Bytes;
using test::eventually;
using test::FakeBoard;
using test::openBoard;

namespace
{
constexpr int stale_ms = 20, fade_ms = 6;   // the guard's watchdog and fade, at 1 kHz

/// A board under a force of 1 N. Time passes in ticks of 1 ms, however long they take. The port itself never gives up.
struct Pushed
{
    explicit Pushed (test::BoardProfile profile = {})
    {
        board.virtual_ns = 1'000'000'000;
        profile.watchdog = 3600.0;
        device = openBoard (board, profile);
        guard.prepare ({ .ramp = 0.01, .watchdog = 1e-3 * stale_ms }, 1e-3);
    }

    /// A tick without a report.
    double tick()
    {
        board.virtual_ns += 1'000'000;
        return answer();
    }

    /// The rest of a tick, after its report.
    double answer()
    {
        reading = device->read();
        const auto applied = guard ({ { 1.0, 0.0, 0.0 }, Vec3::Zero() }, reading);
        device->write (applied);
        return applied.force.x();
    }

    double tick (Bytes report)
    {
        board.virtual_ns += 1'000'000;
        const auto before = device->port().lastArrival();   // changes once the report is in the ring
        board.send (std::move (report));
        REQUIRE (eventually ([&] { return device->port().lastArrival() != before; }));
        return answer();
    }

    /// Good reports until the force is there. Each has another number, time and position.
    void push()
    {
        for (int k = 0; k < 60; ++k)
            tick (next());
        REQUIRE (tick (next()) == 1.0);
    }

    Bytes next (std::uint16_t on = 1, std::uint8_t flags = 1)
    {
        count = static_cast<std::uint16_t> (count + on);
        now_us += 1000u * on;
        auto report = boardReport (count, count);
        report[1] = flags;
        std::memcpy (report.data() + 16, &now_us, 4);
        return report;
    }

    /// The number of ticks until the force is 0.
    template <typename Report>
    int ticksToZero (Report next_report)
    {
        for (int k = 1; k <= 1000; ++k)
            if (tick (next_report()) == 0.0) return k;
        return 1001;
    }

    std::string why() const { return describe (guard.latest()); }

    FakeBoard board;
    std::unique_ptr<HidDevice> device;
    Guard guard;
    Reading reading;
    std::uint16_t count = 0;
    std::uint32_t now_us = 0;
};

const test::BoardProfile with_clock { .more_fields = R"(, {"name": "time", "at": 16, "type": "u32le", "scale": "1 us"})",
                                      .more_of_input = R"(, "timestamp": "time")" };

const test::BoardProfile with_alarms {
    .more_fields = R"(, {"name": "too_hot", "at": 1, "type": "u1", "bit": 1}, {"name": "driven", "at": 1, "type": "u1", "bit": 2})",
    .more = R"("alarms": [{"field": "too_hot", "means": "too_hot"}, {"field": "driven", "is": 0, "means": "not_driven", "while_driven": "50 ms"}],)",
};
constexpr std::uint8_t homed = 1, hot = 2, driven = 4;
}   // namespace

TEST_CASE ("a board that repeats its report loses the force like a silent one, and the stop names the reason", "[hid][safety]")
{
    Pushed run;
    run.push();
    const auto last = run.next();
    CHECK (run.ticksToZero ([&] { return last; }) <= 1 + stale_ms + 1 + fade_ms);
    CHECK (run.guard.stop() == Guard::Stop::stale);
    CHECK (run.why().starts_with ("the device repeats the same report: the last reading is 2"));
    CHECK (run.why().ends_with ("the watchdog allows 20 ms"));
    run.push();
}

TEST_CASE ("a board that sends each report twice keeps the force", "[hid][safety]")
{
    Pushed run;
    run.push();
    for (int k = 0; k < 100; ++k)
    {
        const auto report = run.next();
        CHECK (run.tick (report) == 1.0);
        CHECK (run.reading.age == 0.0);
        CHECK (run.tick (report) == 1.0);
        CHECK (run.reading.age == 1e-3);
    }
}

TEST_CASE ("a board whose clock stops while its reports continue loses the force, and the stop names the reason", "[hid][safety]")
{
    Pushed run { with_clock };
    run.push();
    const auto stopped_at = run.now_us;
    const auto stopped = [&] {
        auto report = run.next();
        std::memcpy (report.data() + 16, &stopped_at, 4);
        return report;
    };
    CHECK (run.ticksToZero (stopped) <= stale_ms + 1 + fade_ms);
    CHECK (run.why().starts_with ("the clock of the device has stopped: the last reading is 2"));
    run.push();
}

TEST_CASE ("a board that restarts loses the force immediately, and gets it back along the ramp after 16 good reports and the wait of the guard",
           "[hid][safety]")
{
    const bool by_clock = GENERATE (false, true);
    Pushed run { by_clock ? with_clock : test::BoardProfile {} };
    run.push();
    run.now_us = 0;
    if (! by_clock) run.count = 0;
    CHECK (run.tick (run.next()) < 1.0);
    CHECK (run.reading.fault == ReadingFault::restarted);
    int good = run.ticksToZero ([&] { return run.next(); });
    CHECK (good < fade_ms);
    CHECK (run.why() == "the report number or the clock of the device went back, as after a restart");

    const int back = 16 + 3 * stale_ms / 2;
    double before = 0.0;
    while (before < 1.0 && good < 100)
    {
        const double force = run.tick (run.next());
        ++good;
        CHECK (force - before <= 0.1 + 1e-9);                            // the ramp: 10 ms
        if (good != back - 1) CHECK ((force > 0.0) == (good >= back));   // rounding
        before = force;
    }
    CHECK (before == 1.0);
}

TEST_CASE ("a board that loses 14 of 15 reports loses the force, although no reading is too old", "[hid][safety]")
{
    Pushed run;
    run.push();
    double oldest = 0.0;
    const auto oneIn = [&] (std::uint16_t n, int most) {
        for (int k = 1; k <= most; ++k)
        {
            const double force = k % n == 0 ? run.tick (run.next (n)) : run.tick();
            oldest = std::max (oldest, run.reading.age);
            if (force == 0.0) return k;
        }
        return 0;
    };
    CHECK (oneIn (2, 200) == 0);   // half of them are enough
    run.push();
    const int ticks = oneIn (15, 200);
    CHECK (ticks > 0);
    CHECK (ticks <= 30 + fade_ms);
    CHECK (oldest < 1e-3 * stale_ms);
    CHECK (run.why() == "more than half of the device's reports are missing");
    run.push();
    CHECK (run.device->counts().restarts == 0);
}

TEST_CASE ("a board with an alarm loses the force immediately, and the stop says what the alarm means", "[hid][safety]")
{
    Pushed run { with_alarms };
    for (int k = 0; k < 100; ++k)
        run.tick (run.next (1, homed | driven));
    REQUIRE (run.guard.stop() == Guard::Stop::none);

    CHECK (run.ticksToZero ([&] { return run.next (1, homed | driven | hot); }) <= fade_ms);
    CHECK (run.why() == "the device reports that a motor is too hot");
    for (int k = 0; k < 40; ++k)
        run.tick (run.next (1, homed | driven));
    CHECK (run.guard.stop() == Guard::Stop::none);

    CHECK (run.ticksToZero ([&] { return run.next (1, driven); }) <= fade_ms);
    CHECK (run.why() == "the device reports that it does not know its position");
}

TEST_CASE ("a board that does not drive its motors gets no force after it has been asked for 50 ms", "[hid][safety]")
{
    Pushed run { with_alarms };
    const auto undriven = [&] { return run.next (1, homed); };
    for (int k = 0; k < 40; ++k)
        run.tick (undriven());
    CHECK (run.guard.stop() == Guard::Stop::none);   // it has not had time to answer
    CHECK (run.ticksToZero (undriven) <= 50 - 40 + 2 + fade_ms);
    CHECK (run.why() == "the device reports that its motors are not driven");

    int good = 1;
    for (; good < 40 && run.tick (run.next (1, homed | driven)) == 0.0; ++good)
        ;
    CHECK (good >= 3 * stale_ms / 2 - 1);                    // the wait of the guard
    CHECK (run.tick (run.next (1, homed | driven)) < 0.3);   // the ramp
    CHECK (run.guard.stop() == Guard::Stop::none);
}

TEST_CASE ("each reason for having no reading is named: no report yet, unplugged, malformed", "[hid][safety]")
{
    Pushed run;
    run.tick();
    CHECK (run.reading.fault == ReadingFault::no_report);
    run.push();
    run.tick (Bytes (3));
    CHECK (run.reading.fault == ReadingFault::malformed);
    run.push();
    run.board.plug (false);
    REQUIRE (eventually ([&] { return ! run.device->port().isConnected(); }));
    run.tick();
    CHECK (run.reading.fault == ReadingFault::unplugged);
    CHECK (run.why() == "the device is unplugged");
}
