// SPDX-License-Identifier: MIT
// The ramp of a guard, for a graph that asks for more than the limits allow.
#include <tactus/run/guard.hpp>

#include <catch2/catch.hpp>
#include <rapidcheck.h>

#include <algorithm>
#include <cmath>

using namespace tactus;

namespace
{
constexpr double dt = 1e-3;
constexpr double rounding = 1.0 + 1e-12;

Effort pushOf (double size)
{
    Effort e { .force = { size, 0.0, 0.0 }, .torque = { 0.0, size, 0.0 } };
    e.axes.set (0, size);
    e.signals.set (0, -size);
    return e;
}
}   // namespace

TEST_CASE ("guard: the ramp lasts as long for a graph that asks for far more than the limits", "[framework][guard]")
{
    const double wanted = GENERATE (2.0, 20.0, 2e6, 1e300);
    const GuardLimits limits { .max_force = 2.0, .max_torque = 2.0, .ramp = 0.1, .max_axis_effort = 2.0, .max_signal = 2.0 };
    Guard guard;
    guard.prepare (limits, dt);
    for (int k = 1; k <= 120; ++k)
    {
        const auto out = guard (pushOf (wanted), {});
        const double most = std::min (1.0, k / 100.0) * 2.0 * rounding;
        CAPTURE (wanted, k);
        REQUIRE (out.force.norm() <= most);
        REQUIRE (out.torque.norm() <= most);
        REQUIRE (std::abs (out.axes[0]) <= most);
        REQUIRE (std::abs (out.signals[0]) <= most);
        if (k == 100) REQUIRE (out.force.x() == Approx (2.0));
    }
}

TEST_CASE ("guard: after a stop, a push beyond the limits returns along the ramp, and never exceeds what was there before", "[framework][guard]")
{
    rc::check ([] {
        const double wanted = *rc::gen::inRange (10, 10'000) / 10.0, ramp = *rc::gen::inRange (1, 200) * 1e-3;
        const int stopped = *rc::gen::inRange (1, 20);
        Guard guard;
        guard.prepare ({ .max_force = 1.0, .ramp = ramp }, dt);
        for (int k = 0; k < 300; ++k)
            guard (pushOf (wanted), {});
        for (int k = 0; k < stopped; ++k)
            guard (pushOf (wanted), { .valid = false });
        // What is left of the force before the stop falls within the fade; the rest rises along the ramp.
        const double left = std::max (0.0, 1.0 - stopped * dt / Guard::fade_s);
        for (int k = 1; k <= 300; ++k)
        {
            const double force = guard (pushOf (wanted), {}).force.x(), risen = std::min (1.0, k * dt / ramp);
            RC_ASSERT (force <= std::min (1.0, risen + std::max (0.0, left - k * dt / Guard::fade_s)) * rounding);
        }
    });
}

TEST_CASE ("guard: after rearm(), an effort without a ramp of its own rises within 0.2 s", "[framework][guard][safety]")
{
    const double ramp = GENERATE (0.0, 0.1);
    const double lasts = ramp > 0.0 ? ramp : Guard::rearm_ramp_s;
    CAPTURE (ramp);
    Guard guard;
    guard.prepare ({ .ramp = ramp }, dt);
    const auto force = [&] (bool is_valid = true) { return guard (pushOf (3.0), { .valid = is_valid }).force.x(); };
    const auto rest = [&] (bool is_valid) {
        for (int k = 0; k < 10; ++k)
            force (is_valid);
        REQUIRE (force (is_valid) == 0.0);
    };
    for (int k = 0; k < 200; ++k)
        force();
    REQUIRE (force() == 3.0);
    for (const bool is_interrupted : { false, true })
    {
        guard.emergencyStop();
        rest (true);
        guard.rearm();
        if (is_interrupted)
        {
            for (int k = 0; k < 20; ++k)
                force();
            rest (false);
        }
        for (int k = 1; k <= 250; ++k)
            REQUIRE (force() == Approx (3.0 * std::min (1.0, k * dt / lasts)));
    }
    rest (false);
    CHECK (force() == Approx (ramp > 0.0 ? 3.0 * dt / ramp : 3.0));   // other stops end as before
}
