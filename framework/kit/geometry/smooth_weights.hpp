// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

namespace tactus
{

/// Weights of the corners of a triangle, like barycentric weights, but their gradients do not jump from a triangle to the next. A
/// value interpolated with them follows 3 t^2 - 2 t^3 along each edge, and has slope 0 across the edge.
///
/// The element of Clough & Tocher 1965 with gradient 0 at the corners and no slope across the edges: a cubic on each of the three
/// triangles between the edges and the centroid. `barycentric` may be slightly negative. `feet[i]` says where the foot of the
/// centroid is on the edge opposite corner i, as a share of the way from corner i + 1 to corner i + 2. [any thread]
constexpr std::array<double, 3> smoothWeights (const std::array<double, 3>& barycentric, const std::array<double, 3>& feet) noexcept
{
    using Ordinate = std::array<double, 3>;   // of the Bezier net, as weights of the corners
    constexpr auto mean = [] (const Ordinate& a, const Ordinate& b, const Ordinate& c) {
        return Ordinate { (a[0] + b[0] + c[0]) / 3.0, (a[1] + b[1] + c[1]) / 3.0, (a[2] + b[2] + c[2]) / 3.0 };
    };
    constexpr std::array<Ordinate, 3> corner { Ordinate { 1.0, 0.0, 0.0 }, Ordinate { 0.0, 1.0, 0.0 }, Ordinate { 0.0, 0.0, 1.0 } };
    std::array<Ordinate, 3> beside {};   // the middle ordinate of the row next to the edge opposite each corner
    for (std::size_t i = 0; i < 3; ++i)
    {
        beside[i][(i + 1) % 3] = 1.0 - feet[i];
        beside[i][(i + 2) % 3] = feet[i];
    }
    std::array<Ordinate, 3> inner {};   // at two thirds of the way from each corner to the centroid
    for (std::size_t i = 0; i < 3; ++i)
        inner[i] = mean (corner[i], beside[(i + 1) % 3], beside[(i + 2) % 3]);
    const Ordinate centre = mean (inner[0], inner[1], inner[2]);

    const auto& n = barycentric;
    const std::size_t opposite = n[0] <= n[1] ? (n[0] <= n[2] ? 0 : 2) : (n[1] <= n[2] ? 1 : 2);
    const std::size_t first = (opposite + 1) % 3, second = (opposite + 2) % 3;
    const double a = n[first] - n[opposite], b = n[second] - n[opposite], c = 3.0 * n[opposite];

    Ordinate sum {};
    for (std::size_t i = 0; i < 3; ++i)
        sum[i] = corner[first][i] * a * a * (a + 3.0 * b + 3.0 * c) + corner[second][i] * b * b * (b + 3.0 * a + 3.0 * c)
                 + 6.0 * beside[opposite][i] * a * b * c + 3.0 * (inner[first][i] * a + inner[second][i] * b) * c * c + centre[i] * c * c * c;
    return sum;
}

}   // namespace tactus
