// SPDX-License-Identifier: MIT
// A smooth surface through the nodes of a mesh: curvature, the change of a force, sharp edges under a round tool. The figures are those of
// docs/decisions/smooth_bodies.md.
#include <tactus/kit/geometry/mesh_walk.hpp>
#include <tactus/kit/geometry/smooth_body.hpp>

#include <nodes/deform/bodies.hpp>

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using tactus::Mat3;
using tactus::Mesh;
using tactus::SmoothBody;
using tactus::Vec3;

namespace
{
using Foot = SmoothBody::Foot;

constexpr double smooth = M_PI, sharp = M_PI / 6.0, stiffness = 1000.0;   // rad; rad; N/m

struct Dice
{
    explicit Dice (unsigned seed) : random (seed) {}
    double uniform() { return std::uniform_real_distribution<double> {}(random); }
    Vec3 vector() { return { gauss (random), gauss (random), gauss (random) }; }
    std::mt19937 random;
    std::normal_distribution<double> gauss;
};

/// A ball whose nodes are moved along it by this share of an edge.
Mesh moved (Mesh mesh, double radius, double share)
{
    Dice dice (5);
    const double edge = (mesh.corner (0, 1) - mesh.corner (0, 0)).norm();
    for (auto& p : mesh.points)
        p = radius * (p + share * edge * dice.vector()).normalized();
    return mesh;
}

/// An open tube along z with rows of nodes that are shifted by half a facet.
Mesh tube (int facets, int rows, double radius, double pitch)
{
    Mesh mesh;
    const auto node = [&] (int i, int j) { return i * facets + (j + facets) % facets; };
    for (int i = 0; i <= rows; ++i)
        for (int j = 0; j < facets; ++j)
        {
            const double angle = 2.0 * M_PI * (j + 0.5 * (i % 2)) / facets;
            mesh.points.push_back ({ radius * std::cos (angle), radius * std::sin (angle), pitch * (i - 0.5 * rows) });
        }
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < facets; ++j)
            if (i % 2 == 0)
            {
                mesh.triangles.push_back ({ node (i, j), node (i, j + 1), node (i + 1, j) });
                mesh.triangles.push_back ({ node (i, j + 1), node (i + 1, j + 1), node (i + 1, j) });
            }
            else
            {
                mesh.triangles.push_back ({ node (i, j), node (i, j + 1), node (i + 1, j + 1) });
                mesh.triangles.push_back ({ node (i, j), node (i + 1, j + 1), node (i + 1, j) });
            }
    return mesh;
}

struct Stroke
{
    double sideways = 0.0;   // the largest part of the force
    double ripple = 0.0;     // rms, N
};

/// Strokes in great circles over a ball, 2 mm deep.
Stroke stroke (const Mesh& mesh, double radius)
{
    const SmoothBody body (mesh, smooth);
    Dice dice (3);
    const double at = radius - 0.002;
    Vec3 p = at * mesh.corner (0, 0).normalized(), axis = Vec3::UnitX();
    Foot foot = body.footOn (0, mesh.corner (0, 0));
    std::vector<double> forces;
    Stroke felt;
    double mean = 0.0;
    for (int k = 0; k < 12'000; ++k)
    {
        if (k % 600 == 0) axis = dice.vector().normalized();
        p += 20e-6 * axis.cross (p).normalized();
        p *= at / p.norm();
        foot = body.followed (foot, p);
        REQUIRE (foot.found);
        const Vec3 force = -stiffness * foot.distance * foot.normal, out = p.normalized();
        felt.sideways = std::max (felt.sideways, (force - force.dot (out) * out).norm() / force.norm());
        forces.push_back (force.norm());
        mean += force.norm() / 12'000.0;
    }
    for (const double f : forces)
        felt.ripple += (f - mean) * (f - mean) / 12'000.0;
    felt.ripple = std::sqrt (felt.ripple);
    return felt;
}
}   // namespace

TEST_CASE ("smooth body: the surface passes through the nodes, and g is smooth", "[kit][geometry]")
{
    for (const auto& mesh : { tactus::test::ball (0.02, 2), moved (tactus::test::ball (0.02, 3), 0.02, 0.15), tactus::test::liverMesh() })
    {
        const SmoothBody body (mesh, smooth);
        Dice dice (1);
        double off = 0.0, slope = 0.0, bend = 0.0;
        for (int t = 0; t < mesh.size(); ++t)
        {
            for (int i = 0; i < 3; ++i)
                off = std::max (off, std::abs (body.valueAt (t, mesh.corner (t, i)).g));
            const double size = (mesh.corner (t, 0) - mesh.corner (t, 1)).norm(), h = 1e-5 * size;
            const Vec3 x = (mesh.corner (t, 0) + mesh.corner (t, 1) + mesh.corner (t, 2)) / 3.0 + 0.1 * size * dice.vector();
            const auto v = body.valueAt (t, x);
            for (int axis = 0; axis < 3; ++axis)
            {
                const auto more = body.valueAt (t, x + h * Vec3::Unit (axis)), less = body.valueAt (t, x - h * Vec3::Unit (axis));
                slope = std::max (slope, std::abs ((more.g - less.g) / (2.0 * h) - v.slope[axis]));
                bend = std::max (bend, size * ((more.slope - less.slope) / (2.0 * h) - v.bend.col (axis)).norm());
            }
        }
        CHECK (off < 1e-13);
        CHECK (slope < 1e-6);
        CHECK (bend < 1e-4);
    }
}

TEST_CASE ("smooth body: a tool in a round body feels no force sideways, and no facets", "[kit][geometry]")
{
    const auto regular = tactus::test::ball (0.02, 3), uneven = moved (regular, 0.02, 0.15);
    for (const auto& mesh : { regular, uneven })
    {
        const auto felt = stroke (mesh, 0.02);
        CHECK (felt.sideways < 0.002);
        CHECK (felt.ripple < 1e-3);
        CHECK (tactus::test::smallestRadius (SmoothBody (mesh, smooth), mesh, 1.0) > 0.95 * 0.02);
    }

    const double radius = 6e-3, depth = 3.5e-3, pitch = 1.36e-3;
    const auto mesh = tube (24, 16, radius, pitch);
    const SmoothBody body (mesh, smooth);
    CHECK (tactus::test::smallestRadius (body, mesh, radius + pitch) > 0.99 * radius);
    Foot foot = body.footOn (mesh.size() / 2, mesh.corner (mesh.size() / 2, 0));
    double sideways = 0.0;
    for (int k = 0; k < 20'000; ++k)
    {
        const double angle = 4.0 * M_PI * k / 20'000.0;
        const Vec3 out { std::cos (angle), std::sin (angle), 0.0 };
        if (k == 0)
            for (int turn = 0; turn < 200; ++turn)   // round to the other side, near the surface
            {
                const Vec3 here { foot.point.x(), foot.point.y(), 0.0 };
                foot = body.followed (foot, (radius - 1e-4) * (here.normalized() + 0.05 * out).normalized());
            }
        foot = body.followed (foot, (radius - depth) * out + Vec3 { 0, 0, 2.0 * pitch * std::sin (0.0037 * k) });
        REQUIRE (foot.found);
        const Vec3 force = -stiffness * foot.distance * foot.normal;
        sideways = std::max (sideways, (force - force.dot (out) * out).norm());
    }
    CHECK (sideways < 2e-3);   // N; a law that interpolates frames has 8 N
}

TEST_CASE ("smooth body: the force changes by no more than nearest points do, for steps of any length", "[kit][geometry]")
{
    const auto bumps = tactus::test::grid (8, 0.056, [] (double x, double y) { return 0.003 * std::sin (143.0 * x) * std::cos (167.0 * y); });
    struct Case
    {
        Mesh mesh;
        Vec3 middle;
        double inner;
    };
    for (const auto& [mesh, middle, inner] : { Case { tactus::test::ball (0.02, 2), Vec3::Zero(), 1.0 },
                                               Case { moved (tactus::test::ball (0.02, 3), 0.02, 0.15), Vec3::Zero(), 1.0 },
                                               Case { bumps, Vec3 { 0.028, 0.028, 0.0 }, 0.018 } })
    {
        Mesh shifted = mesh;
        for (auto& p : shifted.points)
            p -= middle;
        const SmoothBody body (shifted, smooth);
        const double radius = tactus::test::smallestRadius (body, shifted, 1.15 * inner);
        Dice dice (2);
        for (const double step : { 1e-5, 1e-6, 1e-7, 1e-8 })
        {
            double worst = 0.0, deepest = 0.0;
            for (int run = 0; run < 30; ++run)
            {
                int t = 0;
                Vec3 x = Vec3::Zero();
                do
                {
                    t = static_cast<int> (dice.uniform() * shifted.size());
                    x = (shifted.corner (t, 0) + shifted.corner (t, 1) + shifted.corner (t, 2)) / 3.0;
                } while (x.norm() > inner);
                Foot foot = body.footOn (t, shifted.corner (t, 0));
                x = tactus::test::onto (body, t, x);
                const Vec3 n = body.valueAt (t, x).slope.normalized();
                const double depth = 0.88 * radius * (run % 2 == 0 ? 1.0 : dice.uniform());
                for (int k = 1; k <= 20; ++k)
                    foot = body.followed (foot, x - k / 20.0 * depth * n);
                Vec3 p = x - depth * n, way = dice.vector();
                for (int k = 0; k < 200; ++k)
                {
                    if (k % 50 == 0) way = dice.vector();
                    if (k % 100 < 80) way -= way.dot (foot.normal) * foot.normal;
                    way.normalize();
                    const Vec3 q = p + step * way;
                    const Foot next = body.followed (foot, q);
                    if (next.point.norm() > 1.1 * inner) break;
                    const double w = -next.distance;
                    if (w > 0.9 * radius || w < 0.0) break;
                    REQUIRE (next.found);
                    const double change = (next.distance * next.normal - foot.distance * foot.normal).norm();
                    worst = std::max (worst, change / (std::max (1.0, w / (radius - w)) * step));
                    deepest = std::max (deepest, w / radius);
                    foot = next;
                    p = q;
                }
            }
            INFO (step);
            CHECK (worst <= 1.05);
            CHECK (deepest > 0.85);
        }
    }
}

TEST_CASE ("smooth body: a round tool feels the edges and corners of a block as round", "[kit][geometry]")
{
    const double rho = 4e-3;
    for (const auto& mesh : { tactus::test::box ({ 0.04, 0.04, 0.02 }), tactus::test::box ({ 0.04, 0.04, 0.002 }, 4) })
    {
        const SmoothBody body (mesh, sharp);
        Dice dice (7);
        for (const double step : { 1e-5, 1e-6, 1e-7, 1e-8 })
        {
            double worst = 0.0;
            int edges = 0, tips = 0;
            for (int run = 0; run < 60; ++run)
            {
                const int t = static_cast<int> (dice.uniform() * mesh.size());
                const double u = run % 3 == 0 ? 0.0 : dice.uniform();
                Foot foot = body.footOn (t, mesh.corner (t, 0));
                const Vec3 from = (1.0 - u) * mesh.corner (t, 0) + u * mesh.corner (t, 1);
                Vec3 p = from + rho * Vec3 (2.0 * from.x(), 2.0 * from.y(), 40.0 * from.z()).normalized();   // out of a flat block
                foot = body.followed (foot, p);
                REQUIRE (foot.found);
                p = foot.point + rho * (run % 2 == 0 ? 0.1 : 0.1 + 0.9 * dice.uniform()) * foot.normal;
                foot = body.followed (foot, p);
                Vec3 way = dice.vector();
                for (int k = 0; k < 400; ++k)
                {
                    if (k % 100 == 0) way = dice.vector();
                    const Vec3 q = p + step * (k % 5 == 4 ? way : Vec3 { way - way.dot (foot.normal) * foot.normal }).normalized();
                    const Foot next = body.followed (foot, q);
                    REQUIRE (next.found);
                    if (next.distance < 0.1 * rho || next.distance > rho)
                    {
                        way = -way;
                        continue;
                    }
                    edges += next.faces == 2;
                    tips += next.faces == 3;
                    const double w = rho - std::min (next.distance, foot.distance);
                    const double change = ((rho - next.distance) * next.normal - (rho - foot.distance) * foot.normal).norm();
                    worst = std::max (worst, change / (std::max (1.0, w / (rho - w)) * step));
                    // It is the nearest point of the block.
                    if (k % 40 == 0)
                    {
                        Vec3 low = mesh.points[0], high = mesh.points[0];
                        for (const auto& node : mesh.points)
                        {
                            low = low.cwiseMin (node);
                            high = high.cwiseMax (node);
                        }
                        REQUIRE ((next.point - q.cwiseMax (low).cwiseMin (high)).norm() < 1e-9);
                    }
                    foot = next;
                    p = q;
                }
            }
            INFO (step);
            CHECK (worst <= 1.05);
            CHECK (edges > 0);
            CHECK (tips > 0);
        }
    }
}

TEST_CASE ("smooth body: the move of a foot and the mix of the nodes are derivatives", "[kit][geometry]")
{
    const auto mesh = tactus::test::ball (0.02, 3);
    const SmoothBody body (mesh, smooth);
    Dice dice (4);
    std::vector<double> stiff;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
        stiff.push_back (300.0 + 2700.0 * dice.uniform());
    const auto mixed = [&] (const Foot& foot, const SmoothBody::Motion* motion = nullptr) {
        const auto stiffness = [&] (int node) { return stiff[static_cast<std::size_t> (node)]; };
        const auto ones = body.mean (foot, 0.0, [] (double& sum, int, double weight) {
            CHECK (weight >= 0.0);
            sum += weight;
        });
        CHECK (ones == Approx (1.0));
        const auto k = body.mean (foot, 0.0, [&] (double& sum, int node, double weight) { sum += weight * stiffness (node); });
        Vec3 slope = Vec3::Zero();
        if (motion)
        {
            CHECK (body.meanSlope (foot, *motion, [] (int) { return 1.0; }).norm() < 1e-9);
            slope = body.meanSlope (foot, *motion, stiffness);
        }
        return std::pair { k, slope };
    };
    Foot foot = body.footOn (0, mesh.corner (0, 0));
    const Vec3 start = foot.point;
    for (int k = 0; k < 50; ++k)
    {
        const Vec3 p = (0.02 - 0.004 * dice.uniform()) * (start.normalized() + 0.02 * k * start.unitOrthogonal()).normalized();
        foot = body.followed (foot, p);
        const auto motion = body.motionOf (foot, p);
        const auto [k_here, slope] = mixed (foot, &motion);
        const double h = 1e-6, w = -foot.distance;
        const Vec3 force = k_here * w * foot.normal - 0.5 * w * w * slope;   // - dU/dp, U = k w^2 / 2
        for (int axis = 0; axis < 3; ++axis)
        {
            const auto more = body.followed (foot, p + h * Vec3::Unit (axis)), less = body.followed (foot, p - h * Vec3::Unit (axis));
            CHECK (((more.point - less.point) / (2.0 * h) - motion.foot.col (axis)).norm() < 1e-5);
            CHECK (((more.normal - less.normal) / (2.0 * h) - motion.normal.col (axis)).norm() < 1e-5 / 0.02);
            const auto energy = [&] (const Foot& f) { return 0.5 * mixed (f).first * f.distance * f.distance; };
            CHECK (-(energy (more) - energy (less)) / (2.0 * h) == Approx (force[axis]).margin (1e-5 * force.norm()));
        }
    }
}
