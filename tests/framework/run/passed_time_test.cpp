// SPDX-License-Identifier: MIT
// Guards count seconds, not ticks: what happens to stops and limits when ticks are missing, or come too fast.
#include "support/sketch.hpp"

#include <support/property.hpp>
#include <tactus/run/clock/passed_time.hpp>
#include <tactus/run/runner.hpp>

#include <catch2/catch.hpp>

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

TEST_CASE ("the time that passes is the wall time, in periods as far as it can be", "[framework][guard]")
{
    test::property ("whatever the pauses and batches, the sum is never more than the wall time, and never less by more than a period and two blocks", [] {
        const double block = *rc::gen::element (0.0, 5.0 * dt);
        PassedTime passed { dt };
        double wall = 1e5, sum = -passed (wall, block) + dt;
        RC_ASSERT (sum == 0.0);
        for (int k = 0; k < 500; ++k)
        {
            wall += dt * *rc::gen::element (0.0, 0.1, 0.5, 1.0, 1.0, 1.0, 1.9, 3.0, 40.0);
            const double p = passed (wall, block);
            RC_ASSERT (p >= 0.0);
            sum += p;
            RC_ASSERT (sum <= wall - 1e5 + 2e-6 * dt);
            RC_ASSERT (sum >= wall - 1e5 - dt - 2.0 * block - 1e-9);
        }
    });

    test::property ("with jitter of less than a quarter of a period, each tick takes one period, to the last bit", [] {
        PassedTime passed { dt };
        for (int k = 0; k < 1000; ++k)
            RC_ASSERT (passed ((k + (k > 0 ? *rc::gen::inRange (0, 250) / 1000.0 : 0.0)) * dt, 0.0) == dt);
    });

    test::property ("with more of it, no more than a quarter of a period is left to later ticks", [] {
        PassedTime passed { dt };
        double wall = 0.0, sum = -dt;
        for (int k = 0; k < 1000; ++k)
        {
            sum += passed (wall, 0.0);
            RC_ASSERT (sum >= wall - 0.25 * dt - 1e-9);
            wall += *rc::gen::inRange (0, 2000) / 1000.0 * dt;
        }
    });

    SECTION ("in the blocks of a sound card, each tick takes one period, even if each block comes half a block late or early")
    {
        constexpr int block = 20;
        PassedTime passed { dt };
        for (int b = 0; b < 500; ++b)
            for (int i = 0; i < block; ++i)
            {
                const double p = passed ((b + (b % 2) * 0.5) * block * dt, block * dt);
                if (b > 0) CHECK (p == dt);
            }
    }

    SECTION ("ticks that come too fast take the time that there is")
    {
        PassedTime passed { dt };
        passed (0.0, 0.0);
        for (int k = 1; k < 1000; ++k)
            CHECK (passed (k * dt / 8.0, 0.0) == Approx (dt / 8.0));
        CHECK (passed (999 * dt / 8.0 + 50.0 * ms, 0.0) >= 48.9 * ms);   // and save up no time for a later pause
    }
}

TEST_CASE ("guard: a stop takes the same time in seconds, however few ticks there are", "[framework][guard]")
{
    test::property ("any pauses", [] {
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
            const double next = guard (pushing (1.0), {}, dt + lost).force.x();
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
        const double now = guard (pushing (1.0), {}, 51.0 * ms).force.x();
        CHECK (now - before <= 20.0 * dt + 1e-12);
        before = now;
    }
    CHECK (before == 1.0);
}

TEST_CASE ("guard: ticks that come too fast, in batches or late raise the force no faster than its limits allow per second", "[framework][guard]")
{
    test::property ("the force rises by at most the slew times the time that has passed, and by one period's worth in a tick", [] {
        const bool ramps = *rc::gen::arbitrary<bool>();
        constexpr double slew = 10.0, watchdog = 0.02;
        Guard guard;
        guard.prepare ({ .max_slew = ramps ? GuardLimits::none : slew, .ramp = ramps ? 1.0 / slew : 0.0, .watchdog = watchdog }, dt);
        PassedTime passed { dt };
        double wall = 0.0, before = guard (pushing (1.0), {}, passed (wall, 0.0)).force.x();
        RC_ASSERT (before <= slew * dt + 1e-12);
        for (int k = 0; k < 500; ++k)
        {
            wall += dt * *rc::gen::element (0.0, 0.0, 0.125, 0.125, 0.125, 1.0, 1.5, 8.0);
            const double force = guard (pushing (1.0), {}, passed (wall, 0.0)).force.x();
            RC_ASSERT (force - before <= slew * dt + 1e-12);
            RC_ASSERT (force <= slew * (wall + dt) + 1e-9);
            before = force;
        }
    });

    SECTION ("a device at 8 kHz under a profile of 1 kHz gains nothing")
    {
        Guard guard;
        guard.prepare ({ .max_slew = 500.0, .ramp = 0.2 }, dt);
        PassedTime passed { dt };
        double reached = 0.0;
        for (int k = 0; reached == 0.0; ++k)
        {
            const double wall = k * dt / 8.0, force = guard (pushing (1.0), {}, passed (wall, 0.0)).force.x();
            CHECK (force <= (wall + dt) / 0.2 + 1e-12);
            if (force == 1.0) reached = wall;
        }
        CHECK (reached >= 0.199 - 1e-9);
        CHECK (reached <= 0.2);
    }

    SECTION ("batches of reports do not stall the force")
    {
        Guard guard;
        guard.prepare ({ .max_slew = 10.0, .watchdog = 0.02 }, dt);
        PassedTime passed { dt };
        double force = 0.0;
        for (int k = 0; k < 100; ++k)
            force = guard (pushing (1.0), {}, passed (k / 8 * 8 * dt, 0.0)).force.x();   // eight at once, every 8 ms
        CHECK (force >= 10.0 * (100 - 16) * dt);
    }
}

TEST_CASE ("guard: a tool that moves too fast is stopped, however fast its device reports", "[framework][guard]")
{
    test::property ("any rate of reports, with jitter", [] {
        const double per_period = *rc::gen::element (1.0, 2.0, 4.0, 8.0, 16.0);
        const double limit = 2.0, speed = *rc::gen::element (1.8, 3.0);
        Guard guard;
        guard.prepare ({ .max_speed = limit }, dt);
        PassedTime passed { dt };
        double stopped = 0.0;
        for (int k = 0; k * dt / per_period < 0.2; ++k)
        {
            const double t = k * dt / per_period, late = *rc::gen::inRange (0, 100) / 100.0 * 0.2 * dt / per_period;
            guard (pushing (1.0), { .position = { speed * t, 0, 0 } }, passed (t + late, 0.0));
            if (stopped == 0.0 && guard.stop() == Guard::Stop::speed) stopped = t;
        }
        if (speed < limit)
            RC_ASSERT (stopped == 0.0);
        else
        {
            RC_ASSERT (stopped > 0.0);
            RC_ASSERT (stopped <= 0.010);   // the low-pass of 5 ms reaches 2 of 3 m/s after 5.5 ms
        }
    });
}

TEST_CASE ("guard: impulse and energy count the time without ticks, during which the last effort was on the device", "[framework][guard]")
{
    test::property ("the same stop at the same time, whatever share of the ticks is run", [] {
        const int every = *rc::gen::inRange (1, 30);   // a tick comes every so many periods
        const bool by_energy = *rc::gen::arbitrary<bool>();
        auto guard = pushed (by_energy ? GuardLimits { .max_energy = 0.05, .energy_window = 1.0 } : GuardLimits { .max_impulse = 0.3, .impulse_window = 1.0 });
        guard.rearm();
        const double speed = 0.25;   // in m/s, so 1 N gives 0.25 W
        double t = 0.0;
        while (guard.stop() == Guard::Stop::none && t < 1.0)
        {
            t += every * dt;
            guard (pushing (1.0), { .position = { speed * t, 0, 0 } }, every * dt);
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
    test::property ("with a quarter of the ticks or fewer", [] {
        const int every = *rc::gen::inRange (4, 60);
        auto guard = pushed ({ .watchdog = watchdog });
        double t = 0.0, force = 1.0;
        while (force > 0.0 && t < 1.0)
        {
            t += every * dt;
            force = guard (pushing (1.0), {}, every * dt).force.x();
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
            CHECK (guard (pushing (1.0), {}, k % 20 == 0 ? 19.0 * ms : dt).force.x() == 1.0);
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
