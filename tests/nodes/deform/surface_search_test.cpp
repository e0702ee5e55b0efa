// SPDX-License-Identifier: MIT
// How an elastic surface finds the point of its mesh that the tool touches.
#include "support/waiting.hpp"
#include "surface_rig.hpp"

#include <tactus/run/query_thread.hpp>

#include <support/no_allocation.hpp>
#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <chrono>
#include <cmath>
#include <random>

using namespace tactus;
using namespace tactus::test;
using Frictions = ElasticSurface::Friction;

TEST_CASE ("surface: a ball is felt from all sides, with a search of any length", "[nodes][deform]")
{
    property ("presses from random directions", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::normal_distribution<double> bell;
        auto node = made (body (ball (0.03, 3), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
        node.settings.search_ticks = static_cast<int> (seed % 7);
        node.prepare ({ .rate_hz = 1000.0 });
        for (int press = 0; press < 4; ++press)
        {
            const Vec3 towards = Vec3 (bell (dice), bell (dice), bell (dice)).normalized();
            ElasticSurface::Outputs out;
            for (int k = 0; k <= 100; ++k)
                out = node.tick ({ .position = towards * (0.04 - 0.012 * k / 100.0) });
            RC_ASSERT (out.state >= 1.0);
            RC_ASSERT (out.normal.dot (towards) > 0.98);
            RC_ASSERT (out.force.dot (towards) > 0.9 * out.force.norm());
            RC_ASSERT (std::abs (out.depth - 0.002) < 5e-4);   // the ball has facets
            node.tick ({ .position = towards * 0.05 });
        }
    });
}

TEST_CASE ("surface: a search changes no force in contact, and costs only the first ticks", "[nodes][deform]")
{
    property ("the same strokes, searched immediately or later", [] (unsigned seed) {
        const auto surface = uneven (grid (12, 0.04, [] (double x, double y) { return 0.002 * std::sin (90.0 * x) * std::sin (80.0 * y); }), seed);
        auto at_once = made (surface), later = made (surface);
        later.settings.search_ticks = 8;
        later.prepare ({ .rate_hz = 1000.0 });
        for (int k = 0; k < 1000; ++k)
        {
            const double t = 3e-3 * k;
            const Vec3 position (0.02 + 0.015 * std::sin (3.0 * t + seed % 5), 0.02 + 0.015 * std::sin (2.0 * t), 0.003 * std::cos (5.0 * t));
            const ElasticSurface::Inputs in { .position = position };
            const auto a = at_once.tick (in), b = later.tick (in);
            RC_ASSERT (k < 9 || a.force == b.force);
            RC_ASSERT (k < 9 || a.contact == b.contact);
        }
    });
}

TEST_CASE ("surface: searched by a thread on 100 000 triangles, live runs are bit-identical and allocate nothing", "[nodes][deform]")
{
    const auto surface = body (ball (0.03, 7), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } });
    REQUIRE (surface->mesh->triangles.size() > 100'000);

    const auto run = [&] (QueryService* answers, std::chrono::microseconds pause) {
        ElasticSurface node;
        node.settings.surface = surface;
        node.settings.search_ticks = 40;
        node.prepare ({ .rate_hz = 4000.0, .services = { .answers = answers } });
        std::vector<double> forces;
        for (int k = 0; k < 1200; ++k)
        {
            letPass (pause);
            const double t = k / 4000.0;
            const Vec3 p (0.01 * std::sin (30.0 * t), 0.01 * std::cos (20.0 * t), 0.0285 + 0.004 * std::cos (25.0 * t));
            const NoAllocation watch;
            const auto out = node.tick ({ .position = p });
            REQUIRE (watch.allocations() == 0);
            REQUIRE (watch.locks() == 0);
            for (int i = 0; i < 3; ++i)
                forces.push_back (out.force[i]);
        }
        return forces;
    };
    const auto rendered = run (nullptr, {});
    CHECK (std::ranges::any_of (rendered, [] (double f) { return f != 0.0; }));

    for (std::chrono::microseconds pause { 500 };; pause *= 2)   // the busier the machine, the more time the search gets
    {
        QueryThread answers;
        const auto live = run (&answers, pause);
        if (answers.lateTicks() > 0 && pause < std::chrono::milliseconds (20)) continue;
        CHECK (answers.lateTicks() == 0);
        CHECK (live == rendered);
        break;
    }
}

TEST_CASE ("surface: past the rim of an open mesh there is nothing to touch", "[nodes][deform]")
{
    for (const auto friction : { Frictions::bound, Frictions::frictionless })
    {
        auto node = made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }), friction);
        CHECK (node.tick ({ .position = Vec3 (0.3, 0.02, -0.002) }).state == 0.0);
        CHECK (node.tick ({ .position = Vec3 (0.05, 0.05, -0.002) }).state == 0.0);

        double most = 0.0;
        ElasticSurface::Outputs out;
        for (int k = 0; k <= 1000; ++k)
        {
            out = node.tick ({ .position = Vec3 (0.02 + 3e-5 * k, 0.0213, -0.002) });
            most = std::max (most, std::hypot (out.force.x(), out.force.y()));
        }
        CHECK (out.state == 0.0);
        CHECK (most <= 400.0 * 0.002 + 1e-9);                                         // k_t d^z
        CHECK (node.tick ({ .position = Vec3 (0.02, 0.02, -0.002) }).state == 0.0);   // the tool came in past the rim, from behind
        CHECK (node.tick ({ .position = Vec3 (0.02, 0.02, 0.002) }).state == 0.0);
        out = node.tick ({ .position = Vec3 (0.02, 0.02, -0.002) });
        CHECK (out.state > 0.0);
        CHECK (out.hit == Approx (4.0));
    }
}

TEST_CASE ("surface: a path around the rim and up through the surface generates no energy", "[nodes][deform]")
{
    for (const auto friction : { Frictions::bound, Frictions::frictionless })
    {
        Hand hand { made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = 0.01 } }), friction) };
        hand.p = Vec3 (0.06, 0.02, 0.005);
        for (int round = 0; round < 3; ++round)
        {
            hand.line (Vec3 (0.06, 0.02, -0.01), 1000);
            hand.line (Vec3 (0.02, 0.02, -0.01), 1000);
            hand.line (Vec3 (0.02, 0.02, 0.005), 1000);
            hand.line (Vec3 (0.06, 0.02, 0.005), 1000);
            CHECK (hand.work == 0.0);
        }
    }
}

TEST_CASE ("surface: a tool that was inside when the first search ended feels the body once it has been outside", "[nodes][deform]")
{
    auto node = made (body (flat(), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
    node.settings.search_ticks = 20;
    node.prepare ({ .rate_hz = 1000.0 });
    double steepest = 0.0, before = 0.0;
    const auto move = [&] (double depth) {
        const double force = node.tick ({ .position = Vec3 (0.02, 0.01, -depth) }).resistance;
        steepest = std::max (steepest, std::abs (force - before));
        before = force;
    };
    for (int k = 0; k < 100; ++k)
        move (-0.001 + 1e-4 * k);
    CHECK (before == 0.0);
    for (int k = 100; k >= 0; --k)
        move (-0.001 + 1e-4 * k);
    for (int k = 0; k < 100; ++k)
        move (-0.001 + 1e-4 * k);
    CHECK (before > 8.0);
    CHECK (steepest < 0.11);
}

TEST_CASE ("surface: a tool that starts inside gets no energy, with a search of any length", "[nodes][deform][energy]")
{
    for (const int search_ticks : { 0, 8 })
    {
        auto node = made (body (ball (0.03, 3), { { curves (400.0, 1000.0) } }, { { .number = 0.5 } }));
        node.settings.search_ticks = search_ticks;
        node.prepare ({ .rate_hz = 1000.0 });
        for (int k = 0; k <= 100; ++k)
        {
            const auto out = node.tick ({ .position = Vec3 (0.002, 0.001, 0.022 + 0.0002 * k) });   // from 8 mm deep to 12 mm outside
            CHECK (out.force.isZero (0.0));
            CHECK (out.stored_energy == 0.0);
        }
        CHECK (node.tick ({ .position = Vec3 (0.002, 0.001, 0.028) }).state > 0.0);
    }
}
