// SPDX-License-Identifier: MIT
// A body that is round is felt round: no force sideways, no facets, no jumps for a hand, and no corner that is missed.
#include "bodies.hpp"
#include "surface_rig.hpp"

#include <support/no_allocation.hpp>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <string>
#include <vector>

using namespace tactus;
using namespace tactus::test;
using Frictions = ElasticSurface::Friction;

namespace
{
constexpr double pi = std::numbers::pi;

/// An open tube along z, around the origin.
Mesh tube (int facets, int rows, double radius, double length)
{
    Mesh mesh;
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < facets; ++j)
            mesh.points.push_back (
                { radius * std::cos (2.0 * pi * j / facets), radius * std::sin (2.0 * pi * j / facets), length * (static_cast<double> (i) / rows - 0.5) });
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < facets; ++j)
        {
            const int a = i * facets + j, b = i * facets + (j + 1) % facets, c = b + facets, d = a + facets;
            mesh.triangles.push_back ({ a, b, c });
            mesh.triangles.push_back ({ a, c, d });
        }
    return mesh;
}

/// The largest part of the force that is not along the direction out of a round body, and the ripple of the force (rms, N), over a stroke at
/// a depth. `place` gives the direction out at an angle.
struct Felt
{
    double sideways = 0.0, ripple = 0.0;
};
Felt stroked (ElasticSurface node, double radius, double depth, const std::function<Vec3 (double)>& outward, const std::function<Vec3 (double)>& beside)
{
    constexpr int n = 8000;
    Felt felt;
    double sum = 0.0, squares = 0.0;
    node.tick ({ .position = (radius + 1e-3) * outward (0.0) + beside (0.0) });
    for (int k = 0; k <= 20; ++k)
        node.tick ({ .position = (radius + 1e-3 - (depth + 1e-3) * k / 20.0) * outward (0.0) + beside (0.0) });
    for (int k = 0; k < n; ++k)
    {
        const double angle = 2.0 * pi * k / n;
        const Vec3 out = outward (angle), force = node.tick ({ .position = (radius - depth) * out + beside (angle) }).force;
        REQUIRE (force.dot (out) > 0.0);
        felt.sideways = std::max (felt.sideways, (force - force.dot (out) * out).norm() / force.dot (out));
        sum += force.norm() / n;
        squares += force.squaredNorm() / n;
    }
    felt.ripple = std::sqrt (std::max (0.0, squares - sum * sum));
    return felt;
}
}   // namespace

TEST_CASE ("surface: on a ball and on a cylinder, the force has no part sideways, and facets are not felt", "[nodes][deform]")
{
    const auto gum = std::vector<std::vector<Surface::Curves>> { { curves (500.0, 1000.0) } };
    const auto none = [] (double) { return Vec3 { Vec3::Zero() }; };
    const auto circle = [] (double angle) { return Vec3 { std::cos (angle), 0.6 * std::sin (angle), 0.8 * std::sin (angle) }; };
    for (const int divisions : { 3, 4 })
    {
        const auto felt = stroked (made (body (ball (0.02, divisions), gum, {})), 0.02, 0.002, circle, none);
        CHECK (felt.sideways < 0.002);
        CHECK (felt.ripple < 0.005);
    }
    const double radius = 6e-3;
    for (const int facets : { 24, 48 })
    {
        const auto round = [] (double angle) { return Vec3 { std::cos (angle), std::sin (angle), 0.0 }; };
        const auto along = [] (double angle) { return Vec3 { 0.0, 0.0, 3e-3 * std::sin (3.0 * angle) }; };
        const double edge = 2.0 * pi * radius / facets;
        const auto tubular = body (tube (facets, static_cast<int> (0.024 / edge), radius, 0.024), gum, {});
        for (const double depth : { 0.5e-3, 2e-3, 3.5e-3, 5e-3 })   // a law that mixes normals has a pole at 3.5 mm
        {
            const auto felt = stroked (made (tubular), radius, depth, round, along);
            CAPTURE (facets, depth);
            CHECK (felt.sideways < 0.002);
            CHECK (felt.ripple < 0.005);
        }
    }
}

TEST_CASE ("surface: on a ball, a slide has the drag of a flat body, however deep", "[nodes][deform]")
{
    const auto gum = std::vector<std::vector<Surface::Curves>> { { curves (500.0, 1000.0) } };
    const auto circle = [] (double angle) { return Vec3 { std::cos (angle), 0.6 * std::sin (angle), 0.8 * std::sin (angle) }; };
    for (const double depth : { 0.0005, 0.002, 0.008 })
    {
        auto node = made (body (ball (0.02, 3), gum, { { .number = 0.1 } }));
        node.tick ({ .position = 0.021 * circle (0.0) });
        for (int k = 0; k <= 8000; ++k)
        {
            const double angle = 2.0 * pi * k / 8000.0;
            const auto out = node.tick ({ .position = (0.02 - depth) * circle (angle) });
            if (k < 2000) continue;   // until the anchor is as deep as the tool
            const Vec3 drag = out.force - out.force.dot (out.normal) * out.normal;
            REQUIRE (drag.norm() / out.resistance == Approx (0.1 * 500.0 / 1000.0).epsilon (0.02));   // with an anchor at the surface, up to 0.083
        }
    }
}

TEST_CASE ("surface: no tick changes the force on a hand by more than stiffness and curvature say, at 4 kHz and 0.1 m/s", "[nodes][deform]")
{
    // A hand of 50 g on a spring of 300 N/m that goes around the body in circles, well damped.
    constexpr double rate = 4000.0, mass = 0.05, spring = 300.0, damper = 4.0, speed = 0.1;
    for (const double mu : { 0.0, 0.13 })
    {
        auto all = bodies (mu);
        std::erase_if (all, [] (const Body& b) { return b.name == "bumps" || b.name == "uneven pad"; });   // radius of 1.3 mm; steep laws that differ
        const std::vector<std::vector<Surface::Curves>> gum { { curves (500.0, 1000.0) } };
        all.push_back ({ "plate", body (box ({ 0.04, 0.04, 0.002 }, 4), gum, { { .number = mu } }), { 0.0, 0.0, 0.0015 }, { 0.024, 0.024, 0.003 } });
        all.push_back ({ "small ball", body (ball (0.008, 3), gum, { { .number = mu } }), { 0.0, 0.0, 0.0075 }, { 0.005, 0.005, 0.003 } });
        for (const auto& b : all)
        {
            const bool sharp = b.name == "box" || b.name == "plate";
            auto node = made (b.surface, Frictions::bound, rate);
            node.settings.crease = sharp ? 30.0 : 180.0;
            if (sharp) node.settings.tool_radius = { 0.005 };
            node.prepare ({ .rate_hz = rate });
            const std::map<std::string, double> radii { { "pad", 1.0 }, { "sphere", 0.0195 }, { "small ball", 0.0078 }, { "liver", 0.05 } };
            const double radius = sharp ? 0.005 : radii.at (b.name);
            Vec3 p = b.centre + Vec3 (0.0, 0.0, 0.03), v = Vec3::Zero();
            auto before = node.tick ({ .position = p });
            double worst = 0.0;
            int touched = 0, over_edges = 0;
            for (int k = 0; k < 16'000; ++k)
            {
                const double t = k / rate, way = speed * t;
                const double down = std::min (1.0, 4.0 * t), size = (sharp ? 0.96 : 0.8) * std::min (b.reach.x(), b.reach.y());   // over the edges
                const Vec3 aim = b.centre
                                 + Vec3 (size * std::cos (way / size), size * std::sin (way / size),
                                         0.03 * (1.0 - down) - down * 0.002 * (1.0 + std::sin (40.0 * way)));
                const Vec3 force = before.force + spring * (aim - p) - damper * v;
                v += force / mass / rate;
                p += v / rate;
                const NoAllocation watch;
                const auto out = node.tick ({ .position = p });
                REQUIRE (watch.allocations() == 0);
                const double depth = std::max (out.depth, before.depth), moved = v.norm() / rate;
                if (out.state > 0.0 && before.state > 0.0 && depth < 0.9 * radius)
                {
                    double steepest = 0.0;
                    for (const auto& at : b.surface->curves[0])
                        for (const auto& law : at)
                            steepest = std::max (steepest, law.steepest (depth));
                    const double turn = std::max (out.resistance, before.resistance) / (radius - depth);
                    worst = std::max (worst, (out.force - before.force).norm() / (std::max (steepest, turn) * moved));
                    ++touched;
                    over_edges += std::abs (out.normal.z()) < 0.99;
                }
                before = out;
            }
            CAPTURE (b.name, mu, touched, worst);
            CHECK (touched > 2000);
            CHECK (worst <= 1.2);
            if (sharp) CHECK (over_edges > 100);
        }
    }
}

TEST_CASE ("surface: a poke at a corner, an edge or a face of a thin plate is never missed", "[nodes][deform]")
{
    const Vec3 size (0.04, 0.04, 0.002), half = 0.5 * size;
    std::mt19937 dice (3);
    std::uniform_real_distribution<double> one (-1.0, 1.0);
    for (const int cells : { 1, 4 })
        for (const double radius : { 0.0, 1e-3, 4e-3 })
        {
            auto node = made (body (box (size, cells), { { curves (500.0, 1000.0) } }, { { .number = 0.3 } }), Frictions::bound, 4000.0);
            node.settings.tool_radius = { radius };
            int missed = 0;
            for (int poke = 0; poke < 200; ++poke)
            {
                // Straight at a place inside, near a corner, an edge or anywhere, from any direction.
                Vec3 aim (one (dice), one (dice), one (dice)), from (one (dice), one (dice), one (dice));
                for (int axis = 0; axis < 3; ++axis)
                    if (poke % 4 > axis) aim[axis] = std::copysign (0.98, aim[axis]);
                aim = aim.cwiseProduct (half);
                from = aim + 0.03 * from.normalized();
                if ((from.cwiseAbs() - half).maxCoeff() < radius + 1e-4) continue;
                node.prepare ({ .rate_hz = 4000.0 });
                bool touched = false;
                const double step = poke % 2 == 0 ? 2.5e-5 : 2.5e-4;
                const int n = static_cast<int> (0.03 / step);
                for (int k = 0; k <= n && ! touched; ++k)
                    touched = node.tick ({ .position = from + (aim - from) * k / n }).state > 0.0;
                missed += ! touched;
            }
            CAPTURE (cells, radius);
            CHECK (missed == 0);
        }
}

TEST_CASE ("surface: a round tool rolls over the edge of a block, and a warning says how deep", "[nodes][deform]")
{
    const auto block = body (box ({ 0.04, 0.04, 0.02 }), { { curves (500.0, 1000.0) } }, {});
    CHECK (made (block).warning ({}).find ("at any depth") != std::string::npos);
    auto node = made (block);
    node.settings.tool_radius = { 0.004 };
    node.prepare ({ .rate_hz = 1000.0 });
    CHECK (node.warning ({}).find ("from a depth of 4 mm") != std::string::npos);
    node.settings.crease = 180.0;
    CHECK (node.warning ({}).find ("too coarse for round edges") != std::string::npos);
    node.settings.crease = 30.0;
    CHECK (made (body (ball (0.02, 3), { { curves (500.0, 1000.0) } }, {})).warning ({}).empty());

    // Around the edge at a distance of 1 mm: always 3 mm deep.
    const auto at = [] (double angle, double far) { return Vec3 { 0.02 + far * std::sin (angle), 0.003, 0.01 + far * std::cos (angle) }; };
    node.tick ({ .position = at (0.0, 0.006) });
    for (int k = 0; k <= 1000; ++k)
    {
        const auto out = node.tick ({ .position = at (0.5 * pi * k / 1000.0, 0.001) });
        REQUIRE (out.depth == Approx (0.003));
        REQUIRE ((out.force - 3.0 * Vec3 (std::sin (0.5 * pi * k / 1000.0), 0.0, std::cos (0.5 * pi * k / 1000.0))).norm() < 1e-9);
    }
    node.settings.tool_radius = { 0.001, 0.002 };
    CHECK (node.problem().find ("2 values for 1 tools") != std::string::npos);
    node.settings.tool_radius = { -1.0 };
    CHECK (node.problem().find ("tool_radius") != std::string::npos);
}
