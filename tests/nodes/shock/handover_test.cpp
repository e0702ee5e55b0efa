// SPDX-License-Identifier: MIT
#include <tactus/nodes/deform/plane.hpp>
#include <tactus/nodes/shock/handover.hpp>
#include <tactus/nodes/shock/hunt_crossley.hpp>

#include <support/property.hpp>
#include <support/ready.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

using tactus::Vec3;
using tactus::nodes::Handover;
using tactus::nodes::HuntCrossley;
using tactus::nodes::Plane;
using tactus::test::ready;

namespace
{
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A hand taps a plane. The plane hands over to a played shock, and the shock hands back to the plane.
struct Tap
{
    double rate;
    Plane plane;
    HuntCrossley player;
    Handover handover;

    struct Tick
    {
        double contact, shock;
        Handover::Outputs out;
    };

    Tap (double rate_hz, const Plane::Params& wall, double mass, double fade)
        : rate (rate_hz), plane (ready<Plane> (wall, rate_hz)), player (ready<HuntCrossley> ({ .mass = mass }, rate_hz)),
          handover (ready<Handover> ({ .fade = fade }, rate_hz))
    {
    }

    Tick at (double depth)
    {
        const auto wall = plane.tick ({ .position = { 0, 0, -depth } });
        const double shock = player.tick ({ .hit = wall.hit }).resistance;
        return { wall.resistance, shock, handover.tick ({ .contact = wall.resistance, .shock = shock, .hit = wall.hit }) };
    }
};
}   // namespace

TEST_CASE ("handover: the force does not jump in either direction, at any speed and rate", "[nodes][shock]")
{
    tactus::test::property ("a tap that goes in, stays and leaves", [] (unsigned seed) {
        std::mt19937 random { seed };
        const auto size = [&] (double from, double to) { return std::exp (std::uniform_real_distribution { std::log (from), std::log (to) }(random)); };
        const double rate = size (500.0, 20'000.0), v = size (0.02, 2.0), fade = size (2e-3, 0.1), deepest = size (1e-3, 5e-3);
        Tap tap { rate, { .stiffness = size (200.0, 4000.0), .damping = size (0.1, 5.0) }, size (0.005, 0.2), fade };

        const int apart = int (0.003 * rate) + 3, stay = int (0.2 * rate);
        double last = 0.0, largest = 1e-9;
        Tap::Tick before {};
        bool was_played = false, was_back = false;
        for (int k = 0; k < apart + stay; ++k)
        {
            const double depth = std::min (deepest, (k - apart) * v / rate + 0.5 * v / rate);
            const auto now = tap.at (k < apart + stay / 2 ? depth : depth - deepest * 3.0 * (k - apart - stay / 2) / stay);
            const bool played = now.out.state == 2.0;
            // The output may change as much as the input that is rendered, and in addition by the change of the fade.
            const double own = played == (before.out.state == 2.0) ? std::abs (played ? now.shock - before.shock : now.contact - before.contact) : 0.0;
            largest = std::max ({ largest, last, now.contact, now.shock });   // upper bound of |r|
            RC_ASSERT (std::abs (now.out.resistance - last) <= own + 1.6 * largest / (fade * rate) + 1e-12);
            RC_ASSERT (now.out.resistance >= 0.0);
            was_played = was_played || (played && now.shock > 0.0);
            was_back = was_back || (was_played && now.out.state == 1.0);
            last = now.out.resistance;
            before = now;
        }
        RC_ASSERT (was_played);
        RC_ASSERT (was_back);
    });
}

TEST_CASE ("handover: on the tick of either change the force stays exactly where it was", "[nodes][shock]")
{
    auto node = ready<Handover> ({ .fade = 0.01 });
    CHECK (node.tick ({ .contact = 0.7 }).resistance == 0.7);
    const auto hit = node.tick ({ .contact = 5.0, .hit = 1.0 });
    CHECK (hit.resistance == Approx (0.7));
    CHECK (hit.state == 2.0);
    for (int k = 0; k < 30; ++k)
        node.tick ({ .contact = 9.0, .shock = 2.0 });
    const auto played = node.tick ({ .contact = 9.0, .shock = 2.0 });
    CHECK (played.resistance == 2.0);   // the contact is ignored while the shock is played
    const auto back = node.tick ({ .contact = 4.0 });
    CHECK (back.resistance == Approx (2.0));
    CHECK (back.state == 1.0);
    double last = back.resistance;
    for (int k = 0; k < 10; ++k)
    {
        const double now = node.tick ({ .contact = 4.0 }).resistance;
        CHECK (now > last);
        last = now;
    }
    CHECK (last == Approx (4.0));
}

TEST_CASE ("handover: a touch without a hit is rendered as it is measured", "[nodes][shock]")
{
    auto node = ready<Handover> ({});
    CHECK (node.tick ({}).state == 0.0);
    for (const double f : { 0.0, 0.4, 3.0, 0.2, 0.0 })
        CHECK (node.tick ({ .contact = f }).resistance == f);
}

TEST_CASE ("handover: while the shock is played, the measured position has no effect", "[nodes][shock]")
{
    auto one = ready<Handover> ({}), other = ready<Handover> ({});
    std::mt19937 random { 1 };
    one.tick ({});
    other.tick ({});
    for (int k = 0; k < 100; ++k)
    {
        const double hit = k == 0 ? 0.5 : 0.0, shock = k == 0 ? 0.0 : 1.0 + std::sin (k);
        const double a = one.tick ({ .contact = std::uniform_real_distribution { 0.0, 9.0 }(random), .shock = shock, .hit = hit }).resistance;
        CHECK (a == other.tick ({ .contact = 1.0, .shock = shock, .hit = hit }).resistance);
        CHECK (a == shock);   // the force began at 0, so there is nothing to fade
    }
}

TEST_CASE ("handover: handing back to the contact gives at most the energy that the contact stores at the deepest point", "[nodes][shock][energy]")
{
    tactus::test::property ("any spring and path", [] (unsigned seed) {
        std::mt19937 random { seed };
        const auto uniform = [&] (double from, double to) { return std::uniform_real_distribution { from, to }(random); };
        const double rate = 20'000.0, K = uniform (200.0, 5000.0), at = uniform (1e-4, 3e-3), swing = uniform (0.0, 2e-3), w = uniform (5.0, 200.0);
        const bool stays = random() % 3 == 0;
        auto node = ready<Handover> ({ .fade = stays ? tactus::inf : uniform (2e-3, 0.1) }, rate);
        node.tick ({});
        node.tick ({ .contact = 0.0, .shock = 1.0, .hit = 1.0 });
        node.tick ({ .contact = K * at, .shock = 1e-9 });

        double taken = 0.0, deepest = at, last_depth = at, last_force = 0.0;
        for (int k = 0; k < 6000; ++k)
        {
            const double depth = k < 4000 ? at + swing * std::sin (w * k / rate) : last_depth - (at + swing) / 1500.0;
            const double force = node.tick ({ .contact = K * std::max (0.0, depth) }).resistance;
            taken -= 0.5 * (force + last_force) * (depth - last_depth);
            if (k < 4000) deepest = std::max (deepest, depth);
            last_depth = depth;
            last_force = force;
        }
        RC_ASSERT (last_force == 0.0);
        RC_ASSERT (taken <= (stays ? 1e-3 : 1.01) * 0.5 * K * deepest * deepest);
    });
}

TEST_CASE ("handover: a fault gives 0 and makes the next sample a new contact, and a hit that is not finite does not count", "[nodes][shock]")
{
    for (const double bad : { not_a_number, tactus::inf, -tactus::inf })
    {
        auto node = ready<Handover> ({});
        node.tick ({});
        node.tick ({ .contact = 1.0, .hit = 1.0 });
        CHECK (node.tick ({ .contact = 1.0, .shock = bad }).state == -1.0);
        const auto out = node.tick ({ .contact = bad });
        CHECK (out.resistance == 0.0);
        CHECK (out.state == -1.0);
        CHECK (node.tick ({ .contact = 2.0, .hit = bad }).resistance == 2.0);
        CHECK (node.tick ({ .contact = 2.5, .hit = -1.0 }).resistance == 2.5);
    }
}

TEST_CASE ("handover: an instance that replaces another one continues its fade", "[nodes][shock]")
{
    auto old = ready<Handover> ({}), twin = ready<Handover> ({}), next = ready<Handover> ({});
    for (auto* node : { &old, &twin })
    {
        node->tick ({ .contact = 1.0 });
        node->tick ({ .contact = 3.0, .hit = 0.5 });
        node->tick ({ .contact = 3.0 });
    }
    next.adopt (old);
    for (int k = 0; k < 40; ++k)
        CHECK (next.tick ({ .contact = 3.0 }).resistance == twin.tick ({ .contact = 3.0 }).resistance);
}
