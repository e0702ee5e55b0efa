// SPDX-License-Identifier: MIT
#pragma once

#include "surface_rig.hpp"

#include <fstream>
#include <sstream>
#include <string>

/// Bodies on which an elastic surface with a careless slip rule would generate energy.
namespace tactus::test
{

/// A closed box centred at the origin, with n x n cells on each side.
inline Mesh box (const Vec3& size, int n = 1)
{
    Mesh mesh;
    std::map<std::array<long, 3>, int> known;
    const auto point = [&] (const Vec3& p) {
        const std::array<long, 3> key { std::lround (p.x() * 1e9), std::lround (p.y() * 1e9), std::lround (p.z() * 1e9) };
        const auto [at, fresh] = known.try_emplace (key, static_cast<int> (mesh.points.size()));
        if (fresh) mesh.points.push_back (p);
        return at->second;
    };
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : { -0.5, 0.5 })
        {
            int u = (axis + 1) % 3, v = (axis + 2) % 3;
            if (side < 0.0) std::swap (u, v);   // counter-clockwise as seen from outside
            const auto at = [&] (int i, int j) {
                Vec3 p = Vec3::Zero();
                p[axis] = side * size[axis];
                p[u] = size[u] * (static_cast<double> (i) / n - 0.5);
                p[v] = size[v] * (static_cast<double> (j) / n - 0.5);
                return point (p);
            };
            for (int i = 0; i < n; ++i)
                for (int j = 0; j < n; ++j)
                {
                    mesh.triangles.push_back ({ at (i, j), at (i + 1, j), at (i + 1, j + 1) });
                    mesh.triangles.push_back ({ at (i, j), at (i + 1, j + 1), at (i, j + 1) });
                }
        }
    return mesh;
}

/// The mesh of the preset `liver`, in m.
inline Mesh liverMesh()
{
    std::ifstream file (std::string (TACTUS_SOURCE_DIR) + "/graphs/assets/liver.obj");
    Mesh mesh;
    for (std::string line; std::getline (file, line);)
    {
        std::istringstream words (line);
        std::string kind;
        double x = 0.0, y = 0.0, z = 0.0;
        words >> kind >> x >> y >> z;
        if (kind == "v") mesh.points.push_back (1e-3 * Vec3 (x, y, z));
        if (kind == "f") mesh.triangles.push_back ({ static_cast<int> (x) - 1, static_cast<int> (y) - 1, static_cast<int> (z) - 1 });
    }
    return mesh;
}

/// The point of the surface near a point of a triangle.
inline Vec3 onto (const SmoothBody& body, int triangle, Vec3 x)
{
    for (int k = 0; k < 4; ++k)
    {
        const auto v = body.valueAt (triangle, x);
        x -= v.g / v.slope.squaredNorm() * v.slope;
    }
    return x;
}

/// The smallest radius of curvature with its centre inside, over points of all triangles within `inner` of a middle.
inline double smallestRadius (const SmoothBody& body, const Mesh& mesh, double inner, const Vec3& middle = Vec3::Zero())
{
    double most = 0.0;
    for (int t = 0; t < mesh.size(); ++t)
        for (int i = 0; i <= 6; ++i)
            for (int j = 0; j <= 6 - i; ++j)
            {
                const double u = i / 6.0, v = j / 6.0;
                const Vec3 x = (1.0 - u - v) * mesh.corner (t, 0) + u * mesh.corner (t, 1) + v * mesh.corner (t, 2);
                if ((x - middle).norm() > inner) continue;
                const auto value = body.valueAt (t, onto (body, t, x));
                const double length = value.slope.norm();
                const Vec3 n = value.slope / length, a = n.unitOrthogonal(), b = n.cross (a);
                const double p = a.dot (value.bend * a) / length, q = a.dot (value.bend * b) / length, r = b.dot (value.bend * b) / length;
                most = std::max (most, 0.5 * (p + r) + std::sqrt (0.25 * (p - r) * (p - r) + q * q));
            }
    return 1.0 / most;
}

struct Body
{
    std::string name;
    std::shared_ptr<const Surface> surface;
    Vec3 centre, reach;   // of the region in which a hand moves, m
};

inline std::vector<Body> bodies (double mu)
{
    const Surface::Curves gum = curves (500.0, 1000.0), flesh { power (60.0), power (60.0), exponential (0.2, 400.0) };
    const auto bumps = grid (6, 0.04, [] (double x, double y) { return 0.003 * std::sin (300.0 * x) * std::cos (280.0 * y); });
    std::vector<Surface::Curves> varied;
    std::mt19937 dice (5);
    std::uniform_real_distribution<double> soft (0.5, 1.5);
    for (std::size_t i = 0; i < flat().points.size(); ++i)
        varied.push_back (curves (500.0, 1000.0 * soft (dice)));
    const Ratio ratio { .number = mu };
    return {
        { "box", body (box ({ 0.04, 0.04, 0.02 }), { { gum } }, { ratio }), { 0.0, 0.0, 0.009 }, { 0.024, 0.024, 0.006 } },
        { "bumps", body (bumps, { { gum } }, { ratio }), { 0.02, 0.02, 0.0 }, { 0.018, 0.018, 0.006 } },
        { "sphere", body (ball (0.02, 3), { { gum } }, { ratio }), { 0.0, 0.0, 0.018 }, { 0.012, 0.012, 0.006 } },
        { "pad", body (flat(), { varied }, { ratio }), { 0.02, 0.02, -0.001 }, { 0.018, 0.018, 0.004 } },
        { "uneven pad", uneven (flat(), 3, mu), { 0.02, 0.02, -0.001 }, { 0.018, 0.018, 0.003 } },
        { "liver", body (liverMesh(), { { flesh } }, { ratio }), { 0.0, 0.0, -0.002 }, { 0.03, 0.03, 0.008 } },
    };
}

}   // namespace tactus::test
