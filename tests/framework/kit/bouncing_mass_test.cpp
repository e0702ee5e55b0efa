// SPDX-License-Identifier: MIT
#include <support/property.hpp>
#include <tactus/kit/bouncing_mass.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace tactus;

namespace
{
double between (double low, double high) { return low + (high - low) * 1e-6 * *rc::gen::inRange (0, 1'000'001); }

BouncingMass anyBody()
{
    BouncingMass body;
    body.mass = between (0.01, 0.3);
    body.damping = between (0.0, 5.0);
    body.stiffness = std::pow (10.0, between (2.0, 6.0));
    body.force = between (-2.0, 2.0);
    return body;
}
}   // namespace

TEST_CASE ("bouncing mass: without damping it leaves as fast as it came, after half a period", "[kit]")
{
    const BouncingMass body { .mass = 0.1, .stiffness = 5000.0 };
    const double half = std::numbers::pi * std::sqrt (body.mass / body.stiffness);
    const auto [end, touched] = body.after ({ .depth = -1e-3, .speed = 0.2 }, half + 0.01);   // 5 ms before and 5 ms after the bounce
    CHECK (touched);
    CHECK (end.speed == Approx (-0.2).epsilon (1e-12));
    CHECK (end.depth == Approx (-1e-3).epsilon (1e-9));
    CHECK_FALSE (body.after ({ .depth = -1e-3, .speed = 0.2 }, 0.0049).touched);
}

TEST_CASE ("bouncing mass: two steps give the same result as one step of the same length", "[kit]")
{
    test::property ("any mass, spring and force", [] {
        const auto body = anyBody();
        const BouncingMass::State start { .depth = between (-1e-3, 2e-4), .speed = between (-0.5, 0.5) };
        const double t = between (1e-4, 4e-3), share = between (0.1, 0.9);
        const auto once = body.after (start, t), first = body.after (start, share * t), twice = body.after (first.state, (1.0 - share) * t);
        RC_ASSERT (std::abs (once.state.depth - twice.state.depth) < 1e-10);
        RC_ASSERT (std::abs (once.state.speed - twice.state.speed) < 1e-6);
        RC_ASSERT (once.touched == (first.touched || twice.touched));
    });
}

TEST_CASE ("bouncing mass: it follows an independent integration in small steps", "[kit]")
{
    test::property ("any mass, spring and force", [] {
        auto body = anyBody();
        body.stiffness = std::min (body.stiffness, 1e5);
        const BouncingMass::State start { .depth = between (-1e-3, 2e-4), .speed = between (-0.5, 0.5) };
        constexpr double time = 4e-3;
        constexpr int n = 40'000;
        double e = start.depth, v = start.speed;
        for (int i = 0; i < n; ++i)   // leapfrog
        {
            const double h = time / n;
            e += 0.5 * h * v;
            const double pull = body.force - (e > 0.0 ? body.stiffness * e : 0.0), x = 0.5 * h * body.damping / body.mass;
            v = (v * (1.0 - x) + h * pull / body.mass) / (1.0 + x);
            e += 0.5 * h * v;
        }
        const auto end = body.after (start, time).state;
        RC_ASSERT (std::abs (end.depth - e) < 2e-8);
        RC_ASSERT (std::abs (end.speed - v) < 2e-5);
    });
}

TEST_CASE ("bouncing mass: a touch that begins and ends within a step is not missed", "[kit]")
{
    // Without the surface, the mass would turn back 1 um beyond it.
    BouncingMass body { .mass = 0.1, .stiffness = 1e7, .force = -2.0 };
    const double v = std::sqrt (2.0 * 20.0 * 1.001e-3);   // the speed 1 mm before the surface
    const auto [end, touched] = body.after ({ .depth = -1e-3, .speed = v }, 0.02);
    CHECK (touched);
    body.stiffness = 0.0;
    CHECK (end.depth < body.after ({ .depth = -1e-3, .speed = v }, 0.02).state.depth);
}
