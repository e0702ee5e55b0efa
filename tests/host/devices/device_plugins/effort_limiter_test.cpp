// SPDX-License-Identifier: MIT
#include <host/devices/device_plugins/effort_limiter.hpp>

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace tactus;
using host::EffortLimiter;

namespace
{
constexpr GuardLimits hard { .max_force = 2.0,
                             .max_torque = 0.1,
                             .max_slew = 100.0,
                             .max_torque_slew = 5.0,
                             .max_axis_effort = 1.0,
                             .max_axis_slew = 50.0,
                             .max_signal = 3.0,
                             .max_signal_slew = 200.0 };

double number() { return *rc::gen::element (0.0, 1e-3, -0.5, 1.0, -2.0, 1e9, -1e300, std::nan (""), std::numeric_limits<double>::infinity()); }
}   // namespace

TEST_CASE ("no effort exceeds the hard limits, or changes faster than its slew by the wall clock, whatever is asked and however much time passes",
           "[plugins][safety]")
{
    test::property ("for any efforts and times", [] {
        EffortLimiter limiter { hard };
        Effort last;
        for (int k = 0; k < 40; ++k)
        {
            Effort wanted { .force = { number(), number(), number() }, .torque = { number(), number(), number() } };
            for (int i = 0; i < *rc::gen::inRange (0, 4); ++i)
                wanted.axes.set (i, number());
            for (int i = 0; i < *rc::gen::inRange (0, 4); ++i)
                wanted.signals.set (i, number());
            const double passed = *rc::gen::element (0.0, 1e-6, 1e-3, 0.02, -1.0, std::nan ("")), t = passed > 0.0 ? passed : 0.0;
            const auto now = limiter (wanted, passed);
            RC_ASSERT (now.force.norm() <= hard.max_force * (1.0 + 1e-12));
            RC_ASSERT (now.torque.norm() <= hard.max_torque * (1.0 + 1e-12));
            RC_ASSERT ((now.force - last.force).norm() <= hard.max_slew * t + 1e-12);
            RC_ASSERT ((now.torque - last.torque).norm() <= hard.max_torque_slew * t + 1e-12);
            for (int i = 0; i < Channels::most; ++i)
            {
                RC_ASSERT (std::abs (now.axes[i]) <= hard.max_axis_effort);
                RC_ASSERT (std::abs (now.axes[i] - last.axes[i]) <= hard.max_axis_slew * t + 1e-12);
                RC_ASSERT (std::abs (now.signals[i]) <= hard.max_signal);
                RC_ASSERT (std::abs (now.signals[i] - last.signals[i]) <= hard.max_signal_slew * t + 1e-12);
            }
            last = now;
        }
    });
}

TEST_CASE ("without slew limits, an effort within the limits passes at once, bit for bit, and a stop is never held back", "[plugins][safety]")
{
    EffortLimiter limiter { { .max_force = 2.0 } };
    const Effort push { .force = { 0.1, -0.7, 1.3 }, .torque = { 0.3, 0.0, 0.0 }, .axes = { 0.2 }, .signals = { 4.0 } };
    const auto now = limiter (push, 0.0);
    CHECK (now.force == push.force);
    CHECK (now.torque == push.torque);
    CHECK (now.axes[0] == 0.2);
    CHECK (now.signals[0] == 4.0);
    CHECK_FALSE (limiter.isBehind());
    CHECK (limiter ({}, 0.0).force == Vec3 (Vec3::Zero()));
    CHECK (limiter ({}, 0.0).signals[0] == 0.0);
}

TEST_CASE ("a force that is held back keeps its direction, and says so until it is there", "[plugins]")
{
    EffortLimiter limiter { { .max_force = 2.0 } };
    limiter.tighten (100.0, GuardLimits::none, GuardLimits::none);
    const Effort push { .force = { 0.6, 0.8, 0.0 } };
    CHECK (limiter (push, 5e-3).force.isApprox (Vec3 (0.3, 0.4, 0.0)));
    CHECK (limiter.isBehind());
    CHECK (limiter (push, 5e-3).force == push.force);
    CHECK_FALSE (limiter.isBehind());
    limiter.forget();
    CHECK (limiter (push, 0.0).force.norm() == 0.0);
    CHECK (limiter ({ .force = { 30.0, 0.0, 0.0 } }, 1.0).force == Vec3 (2.0, 0.0, 0.0));
    CHECK_FALSE (limiter.isBehind());   // the size is limited for good
}
