// SPDX-License-Identifier: MIT
#include "nearest_triangle.hpp"

#include <algorithm>
#include <limits>

namespace tactus
{

namespace
{
/// The nearest point of the edge from corner i at a to corner j at b.
OnTriangle between (const Vec3& a, const Vec3& b, std::size_t i, std::size_t j, const Vec3& p) noexcept
{
    const Vec3 along = b - a;
    const double length2 = along.squaredNorm();
    const double t = length2 > 0.0 ? std::clamp (along.dot (p - a) / length2, 0.0, 1.0) : 0.0;
    OnTriangle on { { 0.0, 0.0, 0.0 }, a + t * along };
    on.weights[i] = 1.0 - t;
    on.weights[j] += t;
    return on;
}
}   // namespace

OnTriangle nearestOn (const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) noexcept
{
    const Vec3 u = b - a, v = c - a, w = p - a;
    const double uu = u.squaredNorm(), lean = u.dot (v) / uu;
    const Vec3 across = v - lean * u;   // the height over u; products of edges would lose all digits on slivers
    const double height2 = across.squaredNorm();
    if (height2 > 0.0)
    {
        const double third = w.dot (across) / height2, second = w.dot (u) / uu - third * lean;
        if (second >= 0.0 && third >= 0.0 && second + third <= 1.0)
            return { { std::max (0.0, 1.0 - second - third), second, third }, a + second * u + third * v };
    }
    const OnTriangle edges[] { between (a, b, 0, 1, p), between (b, c, 1, 2, p), between (c, a, 2, 0, p) };
    return *std::ranges::min_element (edges, {}, [&] (const OnTriangle& on) { return (on.point - p).squaredNorm(); });
}

OnTriangle nearestOn (const Mesh& mesh, int triangle, const Vec3& p) noexcept
{
    return nearestOn (mesh.corner (triangle, 0), mesh.corner (triangle, 1), mesh.corner (triangle, 2), p);
}

int nearestOfAll (const Mesh& mesh, const Vec3& p) noexcept
{
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int t = 0; t < mesh.size(); ++t)
        if (const double distance2 = (nearestOn (mesh, t, p).point - p).squaredNorm(); distance2 < least)
        {
            best = t;
            least = distance2;
        }
    return best;
}

}   // namespace tactus
