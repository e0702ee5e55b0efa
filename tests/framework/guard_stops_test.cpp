// SPDX-License-Identifier: MIT
// The reasons why a guard stops the force: speed, impulse, energy, the dead-man's switch, the emergency stop.

#include <support/property.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/run/guard/guard_log.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <thread>
#include <vector>

using namespace tactus;

namespace
{
constexpr double dt = 1e-3;
const double not_a_number = std::numeric_limits<double>::quiet_NaN();

Guard guardWith (const GuardLimits& limits, double dt_s = dt)
{
    Guard guard;
    guard.prepare (limits, dt_s);
    return guard;
}

Effort pushing (double x) { return { .force = { x, 0, 0 } }; }
Reading at (double x) { return { .position = { x, 0, 0 } }; }

/// Ticks until the guard stops; -1 if it does not.
template <typename Tick>
int ticksUntilStop (Guard& guard, int most, Tick tick)
{
    for (int k = 0; k < most; ++k)
    {
        tick (k);
        if (guard.stop() != Guard::Stop::none) return k + 1;
    }
    return -1;
}

/// The path of a hand: a few sines, so that it is smooth.
struct Hand
{
    explicit Hand (const std::vector<int>& chance) : amplitudes (chance) {}

    double operator() (int tick) const
    {
        double x = 0.0;
        for (std::size_t i = 0; i < amplitudes.size(); ++i)
            x += 1e-5 * amplitudes[i] * std::sin (2.0 * std::numbers::pi * (0.7 + 1.3 * static_cast<double> (i)) * tick * dt);
        return x;
    }

    std::vector<int> amplitudes;   // in units of 10 um
};

Hand anyHand()
{
    return Hand { *rc::gen::container<std::vector<int>> (4, rc::gen::inRange (-500, 501)) };
}
}   // namespace

TEST_CASE ("guard: a tool that is too fast causes a stop, but one quantum of noise does not", "[framework][guard]")
{
    constexpr double limit = 1.0, quantum = 1e-4;

    test::property ("any speed that is 5 % below or above the limit, measured in quanta", [] {
        const bool too_fast = *rc::gen::arbitrary<bool>();
        const double speed = too_fast ? *rc::gen::element (1.05, 1.5, 4.0) : *rc::gen::element (0.95, 0.5, 0.01);
        const double sign = *rc::gen::element (-1.0, 1.0);
        auto guard = guardWith ({ .max_speed = limit });
        const int stopped = ticksUntilStop (guard, 2000,
                                            [&] (int k) { guard (pushing (1.0), at (sign * quantum * std::floor (speed * k * dt / quantum + 0.5))); });
        RC_ASSERT ((stopped > 0) == too_fast);
        // after a time t, the guard measures a fraction 1 - e^(-t/tau) of the speed
        if (too_fast) RC_ASSERT (stopped * dt <= SpeedWatch::tau * std::log (speed / (speed - limit + 2e-2)) + 20 * dt);
    });

    auto guard = guardWith ({ .max_speed = limit });
    for (int k = 0; k < 500; ++k)
        guard (pushing (1.0), at (k % 2 == 0 ? 0.0 : 2e-3));   // 2 m/s from tick to tick, but no net motion
    CHECK (guard.stop() == Guard::Stop::none);
}

TEST_CASE ("guard: the speed of a device slower than the tick is not overestimated if it reports the age of its readings", "[framework][guard]")
{
    constexpr double tick = 0.25e-3;
    for (const double speed : { 0.9, 1.1 })
    {
        auto guard = guardWith ({ .max_speed = 1.0 }, tick);
        const int stopped = ticksUntilStop (guard, 4000, [&] (int k) {
            const int read = k - k % 8;   // one reading every 2 ms
            Reading r = at (speed * read * tick);
            r.age = (k - read) * tick;
            guard (pushing (1.0), r);
        });
        CHECK ((stopped > 0) == (speed > 1.0));
    }
}

TEST_CASE ("guard: a jump in position after a silence does not count as motion", "[framework][guard]")
{
    auto guard = guardWith ({ .max_speed = 1.0, .max_energy = 0.01, .energy_window = 1.0 });
    for (int k = 0; k < 50; ++k)
        guard (pushing (5.0), at (0.0));
    for (int k = 0; k < 50; ++k)
        guard (pushing (5.0), { .position = { 9, 9, 9 }, .valid = false });
    for (int k = 0; k < 50; ++k)
    {
        guard (pushing (5.0), at (0.2));
        CHECK (guard.stop() == Guard::Stop::none);
    }
}

TEST_CASE ("guard: an impulse above the limit within the window causes a stop, no sooner and at most a sixteenth later", "[framework][guard]")
{
    test::property ("any pushes", [] {
        const double window = *rc::gen::element (0.032, 0.1, 0.5), limit = *rc::gen::element (0.05, 0.2);
        const auto pushes = *rc::gen::container<std::vector<int>> (40, rc::gen::inRange (0, 60));
        auto guard = guardWith ({ .max_impulse = limit, .impulse_window = window });
        std::vector<double> forces;
        const auto within = [&] (double seconds) {
            const auto n = std::min (forces.size(), static_cast<std::size_t> (std::ceil (seconds / dt - 1e-9)));
            double sum = 0.0;
            for (std::size_t i = forces.size() - n; i < forces.size(); ++i)
                sum += std::abs (forces[i]) * dt;
            return sum;
        };
        for (std::size_t k = 0; k < pushes.size() * 50; ++k)
        {
            const double now = guard (pushing (0.1 * pushes[k / 50] * (k % 3 == 0 ? -1.0 : 1.0)), at (0.0)).force.x();
            if (guard.stop() != Guard::Stop::none) break;
            RC_ASSERT (within (window) <= limit + 6.0 * dt + 1e-12);   // the guard detects an excess one tick later
            forces.push_back (now);
        }
        if (guard.stop() == Guard::Stop::none) return;
        RC_ASSERT (guard.stop() == Guard::Stop::impulse);
        RC_ASSERT (within (window * 17.0 / 16.0 + 18 * dt) > limit - 1e-12);
        RC_ASSERT (guard.latest().value > limit);
    });
}

TEST_CASE ("guard: a passive load never trips the energy watchdog", "[framework][guard]")
{
    test::property ("any spring and damper in any hand", [] {
        const auto hand = anyHand();
        const double stiffness = *rc::gen::element (10.0, 200.0, 1000.0), damping = *rc::gen::element (0.0, 0.5, 2.0);

        // The most energy that the spring stores, plus what the held forces of spring and damper leak during the whole run; the
        // spring leaks half K dx^2 per tick.
        double most = 0.0, leak = 0.0;
        for (int k = 0; k < 3000; ++k)
        {
            const double x = hand (k), dx = hand (k + 1) - x;
            most = std::max (most, 0.5 * stiffness * x * x);
            leak += 0.5 * stiffness * dx * dx + damping / dt * std::abs (dx * (hand (k + 1) - 2.0 * x + hand (k - 1)));
        }
        auto guard = guardWith ({ .max_energy = most + leak + 1e-9 });   // without a window, so the limit is for the whole session
        for (int k = 0; k < 3000; ++k)
        {
            const double x = hand (k), v = (x - hand (k - 1)) / dt;
            guard (pushing (-stiffness * x - damping * v), at (x));
            RC_ASSERT (guard.stop() == Guard::Stop::none);
        }
    });
}

TEST_CASE ("guard: an active load trips the energy watchdog exactly when it has delivered more than the limit", "[framework][guard]")
{
    test::property ("any negative damping in any hand", [] {
        const auto hand = anyHand();
        const double limit = *rc::gen::element (1e-4, 1e-3, 1e-2), window = *rc::gen::element (0.0, 0.1, 1.0), drive = *rc::gen::element (0.5, 2.0, 10.0);
        auto guard = guardWith ({ .max_energy = limit, .energy_window = window });

        double bucket = 0.0, on_device = 0.0;
        for (int k = 0; k < 3000; ++k)
        {
            const double x = hand (k), before = hand (k - 1);
            if (k > 0)
                bucket = std::max (0.0, bucket + on_device * (x - before) - (window > 0.0 ? limit / window * dt : 0.0));
            else if (window > 0.0)
                bucket = 0.0;
            on_device = guard (pushing (drive * (x - before) / dt), at (x)).force.x();
            if (std::abs (bucket - limit) < 1e-9) return;   // too close to the limit to decide
            RC_ASSERT ((guard.stop() == Guard::Stop::energy) == (bucket > limit));
            if (bucket > limit) return;
        }
    });
}

TEST_CASE ("guard: the energy that a runaway loop can deliver is bounded", "[framework][guard]")
{
    // A mass on a spring that pushes away, like an unstable wall: the mass gains energy until the guard stops the force.
    constexpr double limit = 0.02, window = 1.0, mass = 0.1;
    auto guard = guardWith ({ .max_force = 20.0, .max_energy = limit, .energy_window = window });
    double x = 1e-3, v = 0.0, given = 0.0, most_power = 0.0;
    for (int k = 0; k < 3000; ++k)
    {
        const double f = guard (pushing (400.0 * x), at (x)).force.x();
        const double moved = v * dt + 0.5 * f / mass * dt * dt;
        given += f * moved;
        most_power = std::max (most_power, f * moved / dt);
        v += f / mass * dt;
        x += moved;
    }
    CHECK (guard.stop() == Guard::Stop::energy);
    CHECK (guard.isAtRest());
    CHECK (given > limit);
    CHECK (given < limit * 2.0 + most_power * (dt + Guard::fade_s));
    CHECK (describe (guard.latest()).starts_with ("the device has given the hand 0.02"));
    CHECK (describe (guard.latest()).ends_with (" J; the limit is 0.02 J in 1 s"));
}

TEST_CASE ("guard: no stop is a step, and a latched stop is cleared only by rearm", "[framework][guard]")
{
    struct Case
    {
        GuardLimits limits;
        Effort wanted;
        Reading bad;
        Guard::Stop why;
    };
    const auto what = GENERATE (as<Case> {},
                                Case { { .max_speed = 1.0 }, pushing (4.0), at (0.5), Guard::Stop::speed },
                                Case { { .max_energy = 1.0, .energy_window = 1.0 }, pushing (4.0), at (0.5), Guard::Stop::energy },
                                Case { { .max_impulse = 0.4, .impulse_window = 1.0 }, pushing (4.0), at (0.0), Guard::Stop::impulse });
    auto guard = guardWith (what.limits);
    double before = 4.0;
    for (int k = 0; k < 99; ++k)
        REQUIRE (guard (what.wanted, at (0.0)).force.x() == 4.0);

    double largest = 0.0;
    const auto tick = [&] (const Reading& r) {
        const double now = guard (what.wanted, r).force.x();
        largest = std::max (largest, std::abs (now - before));
        before = now;
    };
    for (int k = 0; k < 10; ++k)
        tick (what.bad);
    CHECK (guard.stop() == what.why);
    CHECK (guard.isAtRest());
    CHECK (largest <= 4.0 * dt / Guard::fade_s + 1e-12);
    CHECK (guard.latest().value > guard.latest().limit);

    guard.resume();
    for (int k = 0; k < 1000; ++k)
        tick (what.bad);
    CHECK (guard.stop() == what.why);
    CHECK (guard.isAtRest());
    CHECK (guard.events() == 1);

    guard.rearm();
    tick (what.bad);
    CHECK (guard.stop() == Guard::Stop::none);
    CHECK (before == Approx (4.0 * dt / Guard::rearm_ramp_s));
}

TEST_CASE ("guard: with a dead-man's switch, there is force only while the switch is held, and it rises and falls smoothly", "[framework][guard]")
{
    const bool by_button = GENERATE (true, false);
    const GuardLimits limits = by_button ? GuardLimits { .ramp = 0.05, .dead_man_buttons = 6 } : GuardLimits { .ramp = 0.05, .dead_man_pressure = 0.5 };
    Reading held, loose;
    held.buttons = 7;
    held.pressure = 0.5;
    loose.buttons = by_button ? 3 : 7;   // only one of the two required buttons
    loose.pressure = by_button ? 1.0 : 0.2;
    auto guard = guardWith (limits);
    double before = 0.0, largest = 0.0;
    const auto tick = [&] (const Reading& r) {
        const double now = guard (pushing (2.0), r).force.x();
        largest = std::max (largest, std::abs (now - before));
        return before = now;
    };

    for (int k = 0; k < 20; ++k)
        CHECK (tick (loose) == 0.0);
    CHECK (guard.stop() == Guard::Stop::released);
    for (int k = 0; k < 49; ++k)
        CHECK (tick (held) < 2.0);
    CHECK (tick (held) == Approx (2.0));
    tick (held);
    for (int k = 0; k < 6; ++k)
        tick (loose);
    CHECK (guard.isAtRest());
    CHECK (largest <= 2.0 * dt / Guard::fade_s + 1e-12);
    CHECK (describe (guard.latest())
           == (by_button ? "the dead-man's switch is not held" : "the hand presses with 0.2 N; the dead-man's switch requires 0.5 N"));
    for (int k = 0; k < 60; ++k)
        tick (held);
    CHECK (guard.stop() == Guard::Stop::none);

    Reading odd = held;
    odd.pressure = not_a_number;
    tick (odd);
    CHECK ((guard.stop() == Guard::Stop::released) == ! by_button);
}

TEST_CASE ("guard: an emergency stop is reported even if another cause withholds the force, and outlasts that cause", "[framework][guard]")
{
    auto guard = guardWith ({ .dead_man_buttons = 1 });
    guard (pushing (1.0), at (0.0));
    CHECK (guard.latest().why == Guard::Stop::released);
    guard.emergencyStop();
    guard (pushing (not_a_number), at (0.0));
    CHECK (guard.stop() == Guard::Stop::emergency);
    CHECK (describe (guard.latest()) == "the emergency stop was pressed");
    CHECK (guard.events() == 2);

    Reading held;
    held.buttons = 1;
    guard.halt();
    guard.resume();
    guard (pushing (1.0), held);
    CHECK (guard.stop() == Guard::Stop::emergency);
    CHECK (guard.isAtRest());
    CHECK (guard.events() == 2);
    guard.halt();
    guard.rearm();
    guard (pushing (1.0), held);
    CHECK (guard.stop() == Guard::Stop::halted);   // the halt remains
    guard.resume();
    CHECK (guard (pushing (1.0), held).force.x() == Approx (dt / Guard::rearm_ramp_s));
}

TEST_CASE ("guard: every cause is reported with its numbers", "[framework][guard]")
{
    const auto told = [] (const GuardLimits& limits, const Effort& wanted, const Reading& reading) {
        auto guard = guardWith (limits);
        guard (pushing (10.0), at (0.0));
        guard (wanted, reading);
        return describe (guard.latest());
    };
    CHECK (told ({ .max_speed = 1.0 }, {}, at (0.06)) == "the tool moves at 10 m/s; the limit is 1 m/s");
    CHECK (told ({ .max_impulse = 0.005, .impulse_window = 0.5 }, {}, at (0.0)) == "the impulse of the force is 0.01 N*s; the limit is 0.005 N*s in 0.5 s");
    CHECK (told ({ .max_energy = 0.1 }, {}, at (0.03)) == "the device has given the hand 0.3 J; the limit is 0.1 J");
    CHECK (told ({}, { .axes = { 1.0, not_a_number } }, at (0.0)) == "the graph asked for an effort on axis 2 that is not a number: nan");
    CHECK (told ({}, { .signals = { -tactus::GuardLimits::none } }, at (0.0)) == "the graph asked for a signal on channel 1 that is not a number: -inf");
    CHECK (told ({}, {}, at (not_a_number)) == "the reading is not a number: (nan, 0, 0)");
    CHECK (told ({ .watchdog = 0.02 }, {}, { .age = not_a_number }) == "the age of the reading is not a number");
}

TEST_CASE ("guard: the effort of an axis that is no longer commanded falls to zero as fast as the limits allow", "[framework][guard]")
{
    auto guard = guardWith ({ .max_axis_slew = 100.0 });
    for (int k = 0; k < 50; ++k)
        guard ({ .axes = { 0.0, 2.0 } }, at (0.0));
    double before = 2.0;
    for (int k = 1; k <= 20; ++k)
    {
        const double now = guard ({}, at (0.0)).axes[1];
        CHECK (before - now == Approx (0.1));
        before = now;
    }
    CHECK (before == Approx (0.0).margin (1e-9));
}

TEST_CASE ("the log of stops keeps the latest ones, and can be read while new ones arrive", "[framework][guard]")
{
    GuardLog log;
    CHECK (log.since().empty());
    const auto note = [&] (std::uint64_t tick) { log.note ({ tick, "stylus", { .why = Guard::Stop::speed, .value = static_cast<double> (tick) } }); };
    note (7);
    REQUIRE (log.since().size() == 1);
    CHECK (log.since()[0].role == "stylus");
    CHECK (log.since()[0].event.value == 7.0);
    CHECK (log.since (1).empty());
    for (std::uint64_t k = 1; k < 200; ++k)
        note (7 + k);
    const auto all = log.since();
    CHECK (all.size() == GuardLog::most - 1);
    CHECK (all.back().tick == 206);
    CHECK (all.front().tick == 206 - all.size() + 1);
    CHECK (log.since (198).size() == 2);

    std::jthread writer ([&] (const std::stop_token& end) {
        for (std::uint64_t k = 1000; ! end.stop_requested(); ++k)
            note (k);
    });
    int torn = 0;
    for (int k = 0; k < 2000; ++k)
        for (const auto& entry : log.since())
            torn += entry.event.value != static_cast<double> (entry.tick);
    CHECK (torn == 0);
}

TEST_CASE ("guard: a rearm without a latched stop does not reset what the watches have counted", "[framework][guard]")
{
    test::property ("rearmed at any rate", [] {
        const int every = *rc::gen::inRange (1, 100);
        auto guard = guardWith ({ .max_impulse = 0.5, .impulse_window = 10.0 });
        const int stopped = ticksUntilStop (guard, 2000, [&] (int k) {
            if (k % every == 0) guard.rearm();
            guard (pushing (1.0), {});
        });
        RC_ASSERT (stopped > 0);
        RC_ASSERT (stopped <= 502);
    });
}

TEST_CASE ("guard: a latched stop stays latched while another cause is reported", "[framework][guard]")
{
    auto guard = guardWith ({ .max_speed = 1.0 });
    for (int k = 0; k < 100 && ! guard.isLatched(); ++k)
        guard (pushing (1.0), at (4.0 * k * dt));
    CHECK (guard.stop() == Guard::Stop::speed);
    guard (pushing (1.0), { .valid = false });
    CHECK (guard.stop() == Guard::Stop::stale);
    CHECK (guard.isLatched());
    guard.rearm();
    CHECK_FALSE (guard.isLatched());
}

TEST_CASE ("guard: an angle beyond all numbers counts as a rotation that is too fast", "[framework][guard]")
{
    auto guard = guardWith ({ .max_angular_speed = 20.0 });
    for (int k = 0; k < 4; ++k)
        guard (pushing (1.0), { .rotation = { k % 2 * 1.5e308, k % 2 * 1.5e308, 0 } });
    CHECK (guard.stop() == Guard::Stop::speed);
}
