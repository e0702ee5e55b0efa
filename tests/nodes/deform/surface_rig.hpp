// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/nodes/deform/surface.hpp>

#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <utility>
#include <vector>

/// Meshes, surfaces and a hand for the tests of ElasticSurface.
namespace tactus::test
{
using nodes::ElasticSurface;

inline Law power (double k, double n = 1.0) { return { .kind = Law::Kind::power, .a = k, .b = n }; }
inline Law exponential (double a, double b) { return { .kind = Law::Kind::exponential, .a = a, .b = b }; }
inline Surface::Curves curves (double across, double along, double n = 1.0) { return { power (across), power (across), power (along, n) }; }

/// A square of side length on [0, length]², n cells per side, facing up, with heights from a function.
template <typename Height>
Mesh grid (int n, double length, Height height)
{
    Mesh mesh;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i)
        {
            const double x = length * i / n, y = length * j / n;
            mesh.points.push_back (Vec3 (x, y, height (x, y)));
        }
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i)
        {
            const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
            mesh.triangles.push_back ({ a, b, c });
            mesh.triangles.push_back ({ a, c, d });
        }
    return mesh;
}

inline Mesh flat (int n = 4, double length = 0.04)
{
    return grid (n, length, [] (double, double) { return 0.0; });
}

/// A ball about the origin: an octahedron whose faces are divided and pushed out.
inline Mesh ball (double radius, int divisions)
{
    Mesh mesh;
    const Vec3 tips[] { Vec3::UnitX(), Vec3::UnitY(), -Vec3::UnitX(), -Vec3::UnitY(), Vec3::UnitZ(), -Vec3::UnitZ() };
    const int n = 1 << divisions;
    std::map<std::array<long, 3>, int> known;
    const auto point = [&] (const Vec3& p) {
        const std::array<long, 3> key { std::lround (p.x() * n), std::lround (p.y() * n), std::lround (p.z() * n) };
        const auto [at, fresh] = known.try_emplace (key, static_cast<int> (mesh.points.size()));
        if (fresh) mesh.points.push_back (radius * p.normalized());
        return at->second;
    };
    for (int side = 0; side < 4; ++side)
        for (const int pole : { 4, 5 })
        {
            const Vec3 a = tips[pole], b = tips[pole == 4 ? side : (side + 1) % 4], c = tips[pole == 4 ? (side + 1) % 4 : side];
            const auto at = [&] (int i, int j) { return point ((a * (n - i) + b * (i - j) + c * j) / n); };
            for (int i = 0; i < n; ++i)
                for (int j = 0; j <= i; ++j)
                {
                    mesh.triangles.push_back ({ at (i, j), at (i + 1, j), at (i + 1, j + 1) });
                    if (j < i) mesh.triangles.push_back ({ at (i, j), at (i + 1, j + 1), at (i, j + 1) });
                }
        }
    return mesh;
}

inline std::shared_ptr<const Surface> body (Mesh mesh, std::vector<std::vector<Surface::Curves>> tools, std::vector<Ratio> mu)
{
    return std::make_shared<const Surface> (Surface { std::make_shared<const Mesh> (std::move (mesh)), {}, std::move (tools), std::move (mu) });
}

/// Every node of the mesh has its own laws: springs of different stiffness along x and y, and all kinds of laws along z.
inline std::shared_ptr<const Surface> uneven (Mesh mesh, unsigned seed, double mu = 0.5)
{
    std::mt19937 dice (seed);
    std::uniform_real_distribution<double> one (0.0, 1.0);
    std::vector<Surface::Curves> nodes;
    std::vector<Ratio> ratios;
    for (std::size_t i = 0; i < mesh.points.size(); ++i)
    {
        const auto z = [&]() -> Law {
            if (i % 3 == 0) return exponential (0.1 + one (dice), 200.0 * one (dice) + 50.0);
            if (i % 3 == 1) return power (2e4 * (1.0 + one (dice)), 1.5);
            return { .kind = Law::Kind::table, .table = { { 1e-3, 3e-3 }, { 0.5 * one (dice), 2.0 + one (dice) } } };
        };
        const Law along_z = z();
        nodes.push_back ({ power (300.0 + 900.0 * one (dice)), power (300.0 + 900.0 * one (dice)), along_z });
        ratios.push_back ({ .number = mu * (0.5 + one (dice)) });
    }
    return body (std::move (mesh), { nodes }, ratios);
}

inline ElasticSurface made (std::shared_ptr<const Surface> surface, ElasticSurface::Friction friction = ElasticSurface::Friction::bound,
                            double rate_hz = 1000.0)
{
    ElasticSurface node;
    node.settings.surface = std::move (surface);
    node.params.friction = friction;
    node.prepare ({ .rate_hz = rate_hz });
    return node;
}

/// The work of the hand on the last tick, between two positions. While the contact point does not move, the work is the difference of
/// energyAt(); the contact point moves when the tool is at movedAt(). Takes the node before and after the tick.
inline double workOf (const ElasticSurface& earlier, const ElasticSurface& node, const Vec3& from, const Vec3& to)
{
    const double share = node.movedAt();
    const Vec3 between = share < 1.0 ? Vec3 { from + share * (to - from) } : to;
    const double before = earlier.energyAt (between) - earlier.energyAt (from);
    return share < 1.0 ? before + node.energyAt (to) - node.energyAt (between) : before;
}

/// The work of the hand along a path, computed with the trapezoid rule.
struct Hand
{
    ElasticSurface node;
    Vec3 p = Vec3::Zero();
    ElasticSurface::Outputs out {};
    double work = 0.0, moved = 0.0;   // J; moved: the sum of absolute values

    const ElasticSurface::Outputs& to (const Vec3& next)
    {
        const Vec3 before = out.force, step = next - p;
        out = node.tick ({ .position = next });
        const double done = -0.5 * (before + out.force).dot (step);
        work += done;
        moved += std::abs (done);
        p = next;
        return out;
    }

    void line (const Vec3& end, int steps)
    {
        const Vec3 start = p;
        for (int k = 1; k <= steps; ++k)
            to (start + (end - start) * k / steps);
    }
};

}   // namespace tactus::test
