// SPDX-License-Identifier: GPL-3.0-or-later
// Guards count seconds, not ticks: what happens to stops and limits when ticks are missing.
#include "support/sketch.hpp"

#include <tactus/run/lost_time.hpp>
#include <tactus/run/runner.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck/catch.h>

#include <algorithm>
#include <vector>

using namespace tactus;

namespace
{
constexpr double dt = 1e-3, ms = 1e-3;

Effort pushing (double x) { return { .force = { x, 0, 0 } }; }

/// A guard with a force of 1 N on the device.
Guard pushed (const GuardLimits& limits)
{
    Guard guard;
    guard.prepare (limits, dt);
    for (int k = 0; k < 1000 && guard (pushing (1.0), {}).force.x() < 1.0; ++k)
        ;
    return guard;
}
}   // namespace

TEST_CASE ("lost time is the wall time minus the ticks, and a clock that keeps up loses none", "[framework][guard]")
{
    rc::prop ("ticks that are never more than a period late lose nothing", [] {
        LostTime lost { dt };
        for (int k = 0; k < 1000; ++k)
            RC_ASSERT (lost ((k + *rc::gen::inRange (0, 1000) / 1000.0) * dt, 0.0) == 0.0);
    });

    rc::prop ("whatever the pauses, ticks and lost time add up to the wall time", [] {
        LostTime lost { dt };
        double wall = 0.0, sum = 0.0;
        for (int k = 0; k < 500; ++k)
        {
            sum += lost (wall, 0.0);
            const double counted = k * dt + sum;
            RC_ASSERT (counted >= wall - 1.001 * dt);
            RC_ASSERT (counted <= wall + 1.001 * dt);
            wall += dt * (*rc::gen::element (1.0, 1.0, 1.0, 1.9, 3.0, 40.0));
        }
    });

    SECTION ("blocks of a sound card lose nothing, even if each comes half a block late or early")
    {
        constexpr int block = 20;
        LostTime lost { dt };
        for (int b = 0; b < 500; ++b)
            for (int i = 0; i < block; ++i)
                CHECK (lost ((b + (b % 2) * 0.5) * block * dt, block * dt) == 0.0);
    }

    SECTION ("a clock that is faster than the nominal rate saves up no time for a later pause")
    {
        LostTime lost { dt };
        double wall = 0.0;
        for (int k = 0; k < 100000; ++k, wall += 0.99 * dt)
            CHECK (lost (wall, 0.0) == 0.0);
        CHECK (lost (wall + 50.0 * ms, 0.0) >= 47.0 * ms);
    }
}

TEST_CASE ("guard: a stop takes the same time in seconds, however few ticks there are", "[framework][guard]")
{
    rc::prop ("any pauses", [] {
        const double slew = *rc::gen::element (GuardLimits::none, 100.0, 400.0);
        auto guard = pushed ({ .max_force = 1.0, .max_slew = slew });
        const double most = std::max (Guard::fade_s, slew == GuardLimits::none ? 0.0 : 1.0 / slew);
        guard.halt();
        double force = guard (pushing (1.0), {}).force.x();
        RC_ASSERT (force >= 1.0 - dt / Guard::fade_s - 1e-12);   // the stop does not begin with a step
        for (double elapsed = dt; force > 0.0;)
        {
            RC_ASSERT (elapsed < most + 1e-9);
            const double lost = *rc::gen::inRange (0, 4) * ms;
            elapsed += dt + lost;
            const double next = guard (pushing (1.0), {}, lost).force.x();
            RC_ASSERT (next <= force);
            if (slew != GuardLimits::none) RC_ASSERT (force - next <= slew * (dt + lost) + 1e-12);
            force = next;
        }
    });
}

TEST_CASE ("guard: a force does not rise faster, and does not step, after a pause", "[framework][guard]")
{
    Guard guard;
    guard.prepare ({ .max_slew = 20.0, .ramp = 0.1 }, dt);
    double before = 0.0;
    for (int k = 0; k < 300; ++k)
    {
        const double now = guard (pushing (1.0), {}, 50.0 * ms).force.x();
        CHECK (now - before <= 20.0 * dt + 1e-12);
        before = now;
    }
    CHECK (before == 1.0);
}

TEST_CASE ("guard: impulse and energy count the time without ticks, during which the last effort was on the device", "[framework][guard]")
{
    rc::prop ("the same stop at the same time, whatever share of the ticks is run", [] {
        const int every = *rc::gen::inRange (1, 30);   // a tick comes every so many periods
        const bool by_energy = *rc::gen::arbitrary<bool>();
        auto guard = pushed (by_energy ? GuardLimits { .max_energy = 0.05, .energy_window = 1.0 } : GuardLimits { .max_impulse = 0.3, .impulse_window = 1.0 });
        guard.rearm();
        const double speed = 0.25;   // in m/s, so 1 N gives 0.25 W
        double t = 0.0;
        while (guard.stop() == Guard::Stop::none && t < 1.0)
        {
            t += every * dt;
            guard (pushing (1.0), { .position = { speed * t, 0, 0 } }, (every - 1) * dt);
        }
        // 0.3 N s after 0.3 s of 1 N; 0.05 J after t (0.25 W - 0.05 W) = 0.05 J
        const double expected = by_energy ? 0.25 : 0.3;
        RC_ASSERT (t >= expected - 1e-9);
        RC_ASSERT (t <= expected + 2.0 * every * dt + 2.0 * dt);
    });
}

TEST_CASE ("guard: a starved run has no force within twice its watchdog, and says so", "[framework][guard]")
{
    constexpr double watchdog = 0.1;
    rc::prop ("with a quarter of the ticks or fewer", [] {
        const int every = *rc::gen::inRange (4, 60);
        auto guard = pushed ({ .watchdog = watchdog });
        double t = 0.0, force = 1.0;
        while (force > 0.0 && t < 1.0)
        {
            t += every * dt;
            force = guard (pushing (1.0), {}, (every - 1) * dt).force.x();
        }
        RC_ASSERT (t <= 2.0 * watchdog + Guard::fade_s + 2.0 * every * dt);
        RC_ASSERT (guard.stop() == Guard::Stop::starved);
        RC_ASSERT (describe (guard.latest()).starts_with ("the run cannot keep up: its ticks are 1"));
        RC_ASSERT (describe (guard.latest()).ends_with ("; the watchdog allows 100 ms"));

        int ticks = 0;
        while (guard (pushing (1.0), {}).force.x() < 1.0 && ticks < 1000)
            ++ticks;
        RC_ASSERT (ticks >= 50);   // only after it has kept up for a while
        RC_ASSERT (ticks <= 300);
    });

    SECTION ("pauses that make up less than half of the time do not stop it")
    {
        auto guard = pushed ({ .watchdog = watchdog });
        for (int k = 0; k < 10000; ++k)
            CHECK (guard (pushing (1.0), {}, k % 20 == 0 ? 18.0 * ms : 0.0).force.x() == 1.0);
    }

    SECTION ("a guard without a watchdog, as of a simulated device, is never starved")
    {
        auto guard = pushed ({});
        for (int k = 0; k < 100; ++k)
            CHECK (guard (pushing (1.0), {}, 1.0).force.x() == 1.0);
    }
}

TEST_CASE ("a run at 1 MHz with a tenth of a processor has no force within twice its watchdog", "[runtime]")
{
    /// A machine in virtual time that runs the process for 10 ms of every 100 ms, after a second without load.
    struct Shared final : TickClock
    {
        void drive (Ticked& t) noexcept override
        {
            bool more = true;
            while (more)
            {
                more = t.tick (0.0);
                ++ticks;
                time += 1e-6;
                if (time > 1.0 && ticks % 10000 == 0) time += 0.09;
            }
        }
        double now() const noexcept override { return time; }
        std::uint64_t ticks = 0;
        double time = 0.0;
    } clock;

    struct Motor final : Device
    {
        explicit Motor (const Shared& c) : shared (c) {}
        void prepare (double) override {}
        Reading read() noexcept override { return {}; }
        void write (const Effort& e) noexcept override
        {
            if (e.force.x() > 0.0) last_push = shared.time;
            force = e.force.x();
        }
        const Shared& shared;
        double force = 0.0, last_push = 0.0;
    } motor { clock };

    test::Sketch s;
    s.node ("one", "signal.constant", { { "value", 1.0 } }).node ("join", "vector.join").node ("motor", "device.force");
    s.wire ("one.out -> join.x").wire ("join.out -> motor.force");
    Engine engine { s.compile ({ .rate_hz = 1e6 }).plan };
    constexpr double watchdog = 0.1;
    engine.attach ("stylus", motor, { .ramp = 0.1, .watchdog = watchdog });
    Runner runner { engine, clock, 1e6, { .length = 1'100'000 } };
    runner.start();
    runner.wait();
    CHECK (clock.time > 1.9);
    CHECK (motor.last_push > 1.0);
    CHECK (motor.last_push <= 1.0 + 2.0 * watchdog + Guard::fade_s);
    CHECK (runner.status().roles[0].latest == Guard::Stop::starved);
}
