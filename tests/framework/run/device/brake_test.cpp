// SPDX-License-Identifier: MIT
// A brake: the guard's limits on it, and the simulated device that has one.

#include <support/property.hpp>
#include <tactus/run/device/sim.hpp>
#include <tactus/run/guard.hpp>

#include <expert/hands.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace tactus;
using tactus::test::Dice;

namespace
{
constexpr double dt = 1e-3;

Guard guardWith (const GuardLimits& limits)
{
    Guard guard;
    guard.prepare (limits, dt);
    return guard;
}

Effort braking (double damping) { return { .brake = damping }; }
}   // namespace

TEST_CASE ("brake: the guard lets no graph drive it below 0 or above its limit", "[framework][guard][brake][safety]")
{
    test::property ("any damping, any limit, stops and halts in between", [] (unsigned seed) {
        Dice dice { seed };
        const double limit = dice.size (0.01, 100.0), at_stop = dice.size (0.001, 10.0);
        auto guard = guardWith ({ .ramp = dice.uniform (0.0, 0.02), .max_brake = limit, .brake_at_stop = at_stop });
        const double wild[] { 0.0, -0.0, -1.0, -1e-300, inf,
                              -inf, 1e308, std::nan (""), limit, dice.size (1e-3, 1e3) };
        for (int k = 0; k < 400; ++k)
        {
            const auto pick = static_cast<std::size_t> (dice.uniform (0.0, 80.0));
            const double wanted = pick < std::size (wild) ? wild[pick] : 0.5 * limit;
            if (k % 97 == 50) guard.halt();
            if (k % 97 == 70) guard.resume();
            const auto now = guard (braking (wanted), {});
            RC_ASSERT (now.brake >= 0.0);
            RC_ASSERT (now.brake <= limit);
            const bool is_bad = ! isFinite (wanted) || wanted < 0.0;
            if (is_bad) RC_ASSERT (guard.stop() == Guard::Stop::not_finite);
        }
    });
}

TEST_CASE ("brake: what is not a number, or is below 0, stops the role and says so", "[framework][guard][brake][safety]")
{
    for (const double wrong : { std::nan (""), inf, -3.0 })
    {
        auto guard = guardWith ({ .max_brake = 5.0 });
        CHECK (guard (braking (7.0), {}).brake == 5.0);
        double least = 5.0;
        for (int k = 0; k < 10; ++k)
            least = guard (braking (wrong), {}).brake;
        CHECK (least == 0.0);
        CHECK (guard.isAtRest());
        CHECK (describe (guard.latest()).find ("damping of the brake that is not a number of at least 0") != std::string::npos);
        CHECK (guard (braking (2.0), {}).brake == 2.0);
    }
}

TEST_CASE ("brake: a stop releases it within the fade, or takes it to brake_at_stop", "[framework][guard][brake][safety]")
{
    const double held = GENERATE (0.0, 1.5, 9.0);
    auto guard = guardWith ({ .max_brake = 5.0, .brake_at_stop = held });
    CHECK (guard (braking (4.0), {}).brake == 4.0);
    CHECK_FALSE (guard.isAtRest());
    guard.emergencyStop();
    double before = 4.0;
    const double goal = std::min (held, 5.0);
    for (int k = 0; k < 20; ++k)
    {
        const double now = guard (braking (4.0), {}).brake;
        CHECK (std::abs (now - goal) <= std::abs (before - goal));
        CHECK (std::abs (now - before) <= std::abs (4.0 - goal) * dt / Guard::fade_s * (1 + 1e-9) + 1e-12);
        before = now;
    }
    CHECK (before == goal);
    CHECK (guard.isAtRest());
}

TEST_CASE ("brake: a graph and its guard only lower the limit, and do not decide what a stop does", "[framework][guard][brake][safety]")
{
    const GuardLimits device { .max_brake = 5.0, .brake_at_stop = 1.0 };
    CHECK (tightened (device, { .max_brake = 2.0, .brake_at_stop = 3.0 }).max_brake == 2.0);
    CHECK (tightened (device, { .max_brake = 9.0 }).max_brake == 5.0);
    CHECK (tightened (device, { .brake_at_stop = 3.0 }).brake_at_stop == 1.0);
    CHECK (tightened (device, {}).brake_at_stop == 1.0);

    // While a run tightens the limit, the damping falls, and does not step.
    auto guard = guardWith (device);
    CHECK (guard (braking (5.0), {}).brake == 5.0);
    CHECK (guard.tighten ({ .max_brake = 2.0 }));
    double before = 5.0;
    for (int k = 0; k < 50; ++k)
    {
        const double now = guard (braking (5.0), {}).brake;
        CHECK (now <= before);
        CHECK (before - now < 2.9);
        before = now;
    }
    CHECK (before == 2.0);
}

TEST_CASE ("simulated brake: the damping is exact at any rate, and takes energy only", "[framework][devices][brake][energy]")
{
    test::property ("any tool, brake, request and rate: v (t) = v e^(-(b + B) t / m)", [] (unsigned seed) {
        Dice dice { seed };
        const double m = dice.size (0.01, 1.0), b = dice.size (0.01, 5.0), most = dice.size (0.1, 50.0), asked = dice.size (0.01, 100.0),
                     rate = dice.size (500.0, 20e3), v = dice.uniform (-1.0, 1.0), damping = b + std::min (asked, most);
        SimulatedDevice tool ({ .mass = m, .damping = b, .brake = most, .velocity = { v, 0, 0 } });
        tool.prepare (1.0 / rate);
        RC_ASSERT (tool.layout().brake == most);
        for (int k = 1; k <= 50; ++k)
        {
            tool.read();
            tool.write (braking (asked));
            const auto now = tool.read();
            const double decay = std::exp (-damping * k / (rate * m));
            RC_ASSERT (std::abs (now.true_velocity.x() - v * decay) <= 1e-12 * std::abs (v));
            RC_ASSERT (std::abs (now.true_position.x() - v * m / damping * (1.0 - decay)) <= 1e-12 * std::abs (v));
        }
    });

    test::property ("any requests, below 0 and not numbers among them: no tool without a force gets faster", [] (unsigned seed) {
        Dice dice { seed };
        SimulatedDevice tool (
            { .mass = dice.size (0.01, 1.0), .damping = 0.0, .brake = 10.0, .brake_time = dice.uniform (0.0, 0.02), .velocity = { 0.3, -0.2, 0.1 } });
        tool.prepare (dt);
        double before = tool.read().true_velocity.norm();
        for (int k = 0; k < 200; ++k)
        {
            tool.write (braking (k % 17 == 0 ? std::nan ("") : dice.uniform (-20.0, 20.0)));
            const double now = tool.read().true_velocity.norm();
            RC_ASSERT (now <= before * (1.0 + 1e-15));
            before = now;
        }
    });
}

TEST_CASE ("simulated brake: its coil follows with its time constant, and dry friction holds under it", "[framework][devices][brake]")
{
    constexpr double m = 1e6;   // so heavy that the velocity stays: what it loses per tick is proportional to the damping
    SimulatedDevice slow ({ .mass = m, .damping = 0.0, .brake = 10.0, .brake_time = 5e-3, .velocity = { 1, 0, 0 } });
    slow.prepare (dt);
    double before = 1.0;
    for (int k = 1; k <= 20; ++k)
    {
        slow.write (braking (10.0));
        const double now = slow.read().true_velocity.x();
        CHECK ((before - now) * m / dt == Approx (10.0 * (1.0 - std::exp (-k * dt / 5e-3))).epsilon (1e-4));
        before = now;
    }

    SimulatedDevice dry ({ .mass = 0.1, .damping = 0.0, .coulomb = 0.1, .brake = 10.0, .velocity = { 0.01, 0, 0 }, .hand_force = { 0.05, 0, 0 } });
    dry.prepare (dt);
    for (int k = 0; k < 100; ++k)
        dry.write (braking (10.0));
    CHECK (dry.read().true_velocity.x() == 0.0);
}

TEST_CASE ("brake: it changes no faster than its slew limit, in a stop too, and a guard never allows more than the device has",
           "[framework][guard][brake][safety]")
{
    const double slew = 400.0;
    auto guard = guardWith ({ .max_brake = 50.0, .max_brake_slew = slew });
    double before = 0.0;
    const auto changes = [&] (double wanted) {
        const double now = guard (braking (wanted), {}).brake, by = now - before;
        before = now;
        return by;
    };
    for (int k = 0; k < 10; ++k)
        CHECK (changes (1e300) == Approx (slew * dt));
    guard.halt();
    for (int k = 0; k < 10; ++k)
    {
        const double by = changes (1e300);
        CHECK (by <= 0.0);
        CHECK (by >= -slew * dt * (1.0 + 1e-12));
    }
    CHECK (before == Approx (0.0).margin (1e-9));
    guard.resume();
    for (int k = 0; k < 1000; ++k)
        CHECK (std::abs (changes (k % 2 == 0 ? 1e300 : 0.0)) <= slew * dt * (1.0 + 1e-12));

    Guard of_device;
    of_device.prepare ({ .max_brake = 50.0 }, dt, { .brake = 5.0 });
    CHECK (of_device (braking (20.0), {}).brake == 5.0);
    of_device.prepare ({}, dt, { .brake = 5.0 });
    CHECK (of_device (braking (20.0), {}).brake == 5.0);
    of_device.prepare ({ .max_brake = 2.0, .brake_at_stop = 9.0 }, dt, { .brake = 5.0 });
    of_device.emergencyStop();
    for (int k = 0; k < 20; ++k)
        CHECK (of_device (braking (20.0), {}).brake <= 2.0);
    CHECK (of_device (braking (20.0), {}).brake == 2.0);
}
