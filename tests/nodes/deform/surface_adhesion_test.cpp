// SPDX-License-Identifier: MIT
// The contact point of an elastic surface yields by the adhesion functions of Fig. 2.
#include "bodies.hpp"
#include "surface_rig.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace tactus;
using namespace tactus::test;
using Kind = Bristle::Adhesion;

namespace
{
constexpr double depth = 0.002, mu = 0.5, bound = mu * depth;

ElasticSurface pad (Kind kind, double static_ratio = 1.0)
{
    auto node = made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = mu } }));
    node.params.adhesion = kind;
    node.params.static_ratio = static_ratio;
    node.tick ({ .position = Vec3 (0.005, 0.0213, 0.001) });
    node.tick ({ .position = Vec3 (0.005, 0.0213, -depth) });
    return node;
}

double stretchAt (ElasticSurface& node, double x) { return x - node.tick ({ .position = Vec3 (x, 0.0213, -depth) }).contact.x(); }
}   // namespace

TEST_CASE ("bristle: a repeated sample does not change the stretch", "[kit]")
{
    const Curve table { { 0.0, 1.0 }, { 0.2, 1.0 } };
    for (const auto kind : { Kind::stick, Kind::dupont, Kind::ramp, Kind::dahl, Kind::curve })
    {
        const Bristle bristle { .adhesion = kind, .d_max = 1e-3, .d_stick = 1.5e-3, .own = &table };
        const Vec3 d (3e-4, -2e-4, 0.0);
        const auto step = bristle.stretch (d, Vec3::Zero());
        CHECK (step.d == d);
        CHECK_FALSE (step.slips);
    }
}

TEST_CASE ("surface: every adhesion function ends at the bound, and they differ on the way", "[nodes][deform]")
{
    double half[5] {};
    for (const auto kind : { Kind::stick, Kind::dupont, Kind::ramp, Kind::dahl, Kind::curve })
    {
        auto node = pad (kind);
        CAPTURE (static_cast<int> (kind));
        double x = 0.005;
        for (int k = 0; k < 50; ++k)
            half[static_cast<std::size_t> (kind)] = stretchAt (node, x += 1e-5);   // ends at half of the bound
        for (int k = 0; k < 1000; ++k)
            stretchAt (node, x += 1e-5);
        CHECK (stretchAt (node, x += 1e-5) == Approx (bound).epsilon (1e-2));
    }
    CHECK (half[0] == Approx (5e-4));                              // stick does not yield below the bound
    CHECK (half[1] == Approx (5e-4));                              // dupont does not yield below d_ba, 0.7 of the bound
    CHECK (half[3] == Approx (bound * (1.0 - std::exp (-0.5))));   // eq. (1), in closed form
    CHECK (half[2] < half[0]);
    CHECK (half[2] > half[3]);
}

TEST_CASE ("surface: Dahl's contact point creeps under a trembling pull, one that sticks does not", "[nodes][deform]")
{
    const auto walked = [] (Kind kind) {
        auto node = pad (kind);
        const auto pull = [&] (double force) {   // where the tool must be for the contact to pull with this force
            double x = node.tick ({ .position = Vec3 (0.005, 0.0213, -depth) }).contact.x();
            return x + force / 400.0;
        };
        double x = pull (0.1);
        const auto first = node.tick ({ .position = Vec3 (x, 0.0213, -depth) }).contact.x();
        double c = first;
        for (int k = 0; k < 200; ++k)
        {
            x = c + (k % 2 == 0 ? 0.25 : 0.05) / 400.0;   // the bound is 0.4 N
            c = node.tick ({ .position = Vec3 (x, 0.0213, -depth) }).contact.x();
        }
        return c - first;
    };
    CHECK (walked (Kind::stick) == 0.0);
    CHECK (walked (Kind::dahl) > 1e-4);
}

TEST_CASE ("surface: with static_ratio above 1 the contact sticks and slips with the same period at any speed", "[nodes][deform]")
{
    constexpr double ratio = 2.0, period = (ratio - 1.0) * bound;
    for (const double step : { 1e-6, 2.3e-5, 1.7e-4 })
    {
        auto node = pad (Kind::stick, ratio);
        double least = 1.0, most = 0.0, x = 0.005;
        int slips = 0;
        const int n = static_cast<int> (0.022 / step);
        for (int k = 0; k < n; ++k)
        {
            x += step;
            const auto out = node.tick ({ .position = Vec3 (x, 0.0213, -depth) });
            const double stretch = x - out.contact.x();
            if (slips > 0) least = std::min (least, stretch);
            most = std::max (most, stretch);
            slips += out.state == 2.0;
        }
        CAPTURE (step);
        CHECK (most <= ratio * bound * (1.0 + 1e-9));
        CHECK (most > ratio * bound - 1.01 * step);
        CHECK (least < bound + 1.01 * step);
        CHECK (slips == Approx ((n * step - ratio * bound) / period + 1.0).margin (1.0));
    }
}

TEST_CASE ("surface: with every adhesion function, moves of the contact point only lose energy", "[nodes][deform][energy]")
{
    const auto all = bodies (0.3);
    property ("random strokes over uneven pads, bumps and boxes", [&] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const auto& body = all[seed % all.size()];
        auto node = made (body.surface);
        node.params.adhesion = static_cast<Kind> (dice() % 5);
        node.params.static_ratio = dice() % 2 == 0 ? 1.0 : 1.0 + std::abs (one (dice));
        const double top = body.centre.z() + 0.03;
        Vec3 p (0.001, 0.002, top);
        auto before = node.tick ({ .position = p });
        double work = 0.0, moved = 0.0;
        for (int k = 0; k < 300; ++k)
        {
            const Vec3 shake = 0.1 * Vec3 (one (dice), one (dice), one (dice)).cwiseProduct (body.reach);
            const Vec3 next = k % 100 == 0 ? Vec3 { body.centre + 3.0 * shake } : Vec3 { p + shake };
            const auto earlier = node;
            const auto out = node.tick ({ .position = next });
            double step = workOf (earlier, node, p, next);
            RC_ASSERT (out.dissipated_energy >= before.dissipated_energy);
            if (before.state == 0.0) step = out.stored_energy + out.dissipated_energy - before.dissipated_energy;
            work += step;
            moved += std::abs (step);
            RC_ASSERT (std::abs (out.stored_energy + out.dissipated_energy - work) <= 1e-12 * (moved + 1e-9));
            p = next;
            before = out;
        }
    });
}
