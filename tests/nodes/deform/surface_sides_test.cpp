// SPDX-License-Identifier: MIT
// Thin and closed bodies: a tool belongs to the side that it came through.
#include "bodies.hpp"
#include "surface_rig.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace tactus;
using namespace tactus::test;
using Frictions = ElasticSurface::Friction;

namespace
{
std::shared_ptr<const Surface> plate() { return body (box ({ 0.04, 0.04, 0.002 }), { { curves (500.0, 1000.0) } }, { { .number = 0.5 } }); }
}   // namespace

TEST_CASE ("surface: a tool that passes the middle of a thin plate in one sample is pushed back to the side that it came from", "[nodes][deform]")
{
    for (const auto friction : { Frictions::bound, Frictions::frictionless })
        for (const int search_ticks : { 0, 4 })
            for (const double up : { 1.0, -1.0 })
            {
                auto node = made (plate(), friction);
                node.settings.search_ticks = search_ticks;
                node.prepare ({ .rate_hz = 1000.0 });
                for (int k = 0; k < 10; ++k)
                    CHECK (node.tick ({ .position = up * Vec3 (0.003, 0.002, 0.0015) }).state == 0.0);   // 0.5 mm above a face
                const auto out = node.tick ({ .position = up * Vec3 (0.003, 0.002, -0.0005) });          // 1.5 mm below the face, 0.5 mm from the other
                CHECK (out.state > 0.0);
                CHECK (out.depth == Approx (0.0015).epsilon (0.2));   // not exact, because the frames at the corners of the box lean
                CHECK (out.contact.z() == Approx (up * 0.001));
                CHECK (out.force.z() * up > 1.0);
                CHECK (out.hit > 1.0);
            }
}

TEST_CASE ("surface: a tool that jumps through a thin plate is still pushed back", "[nodes][deform]")
{
    auto node = made (plate());
    node.tick ({ .position = Vec3 (0.003, 0.002, 0.0015) });
    const auto out = node.tick ({ .position = Vec3 (0.003, 0.002, -0.0025) });
    CHECK (out.state > 0.0);
    CHECK (out.force.z() > 2.0);

    auto beside = made (plate());
    beside.tick ({ .position = Vec3 (0.0195, 0.002, 0.0015) });
    CHECK (beside.tick ({ .position = Vec3 (0.025, 0.002, 0.0) }).state == 0.0);   // passes through an edge of the plate and out again
}

TEST_CASE ("surface: a tool that jumps through the middle of a ball and out again does not touch it", "[nodes][deform]")
{
    auto node = made (body (ball (0.03, 3), { { curves (500.0, 1000.0) } }, { { .number = 0.5 } }));
    node.tick ({ .position = Vec3 (0.001, 0.002, 0.05) });
    CHECK (node.tick ({ .position = Vec3 (-0.001, -0.002, -0.04) }).state == 0.0);
    const auto out = node.tick ({ .position = Vec3 (-0.001, -0.002, -0.028) });
    CHECK (out.state > 0.0);
    CHECK (out.force.z() < -1.0);
}

TEST_CASE ("surface: fast or slow, a tool that goes into a plate is pushed back in the same direction", "[nodes][deform]")
{
    property ("straight paths from above into the plate", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const Vec3 from (0.012 * one (dice), 0.012 * one (dice), 0.0012 + 0.001 * std::abs (one (dice)));
        const Vec3 to = Vec3 (from.x() + 0.001 * one (dice), from.y() + 0.001 * one (dice), 0.0009 * one (dice));
        for (const int steps : { 1, 2, 7, 200 })
        {
            auto node = made (plate());
            ElasticSurface::Outputs out;
            for (int k = 0; k <= steps; ++k)
                out = node.tick ({ .position = from + (to - from) * k / steps });
            RC_ASSERT (out.state > 0.0);
            RC_ASSERT (out.force.z() > 0.0);
            RC_ASSERT (std::abs (out.contact.z() - 0.001) < 1e-9);
        }
    });
}

TEST_CASE ("surface: a contact that opens inside a body does not begin again before the tool has been outside", "[nodes][deform]")
{
    // The contact point catches on the edge of the box while the tool is dragged off. Whatever the tool then does inside, the energy
    // balance holds (see surface_energy_test.cpp). When it enters from outside, the body is felt again.
    auto node = made (body (box ({ 0.04, 0.04, 0.02 }), { { curves (500.0, 1000.0) } }, { { .number = 0.1 } }));
    node.tick ({ .position = Vec3 (0.0, 0.003, 0.012) });
    node.tick ({ .position = Vec3 (0.0, 0.003, 0.008) });
    for (int k = 0; k <= 1000; ++k)
        node.tick ({ .position = Vec3 (0.00005 * k, 0.003, 0.008) });
    node.tick ({ .position = Vec3 (0.05, 0.003, 0.012) });
    CHECK (node.tick ({ .position = Vec3 (0.0, 0.003, 0.012) }).state == 0.0);
    CHECK (node.tick ({ .position = Vec3 (0.0, 0.003, 0.008) }).state > 0.0);
}

TEST_CASE ("mesh walk: a line into a box crosses one triangle of the side that it enters, and a line out crosses none", "[kit]")
{
    property ("straight paths from outside to inside", [] (unsigned seed) {
        std::mt19937 dice (seed);
        std::normal_distribution<double> bell;
        std::uniform_real_distribution<double> one (-1.0, 1.0);
        const MeshWalk walk { box ({ 0.04, 0.04, 0.02 }, 1 + static_cast<int> (seed % 4)) };
        const Vec3 inside (0.0199 * one (dice), 0.0199 * one (dice), 0.0099 * one (dice));
        const Vec3 outside = 0.1 * Vec3 (bell (dice), bell (dice), bell (dice)).normalized();
        const Spot found = walk.entered (outside, inside);
        RC_ASSERT (found.triangle >= 0);
        const auto corners = cornersOf (walk.mesh(), found.triangle);
        const Vec3 normal = areaNormal (corners), way = inside - outside;
        RC_ASSERT (normal.dot (way) < 0.0);
        const Vec3 there = outside + way * (normal.dot (corners[0] - outside) / normal.dot (way));
        RC_ASSERT ((found.on.point - there).norm() < 1e-9);
        RC_ASSERT (walk.entered (inside, outside).triangle < 0);
    });
}
