// SPDX-License-Identifier: MIT
#pragma once

#include "nearest_triangle.hpp"

#include <Eigen/Geometry>

namespace tactus
{

using Corners = std::array<Vec3, 3>;

inline Corners cornersOf (const Mesh& mesh, int triangle) noexcept
{
    const auto& c = mesh.triangles[static_cast<std::size_t> (triangle)];
    return { mesh.points[static_cast<std::size_t> (c[0])], mesh.points[static_cast<std::size_t> (c[1])], mesh.points[static_cast<std::size_t> (c[2])] };
}

/// Out of the triangle, twice its area long.
inline Vec3 areaNormal (const Corners& c) noexcept { return (c[1] - c[0]).cross (c[2] - c[0]); }

/// How the barycentric weights change over the triangle, 1/m.
inline std::array<Vec3, 3> gradientsOf (const Corners& c) noexcept
{
    const Vec3 n = areaNormal (c), over = n / n.squaredNorm();
    return { over.cross (c[2] - c[1]), over.cross (c[0] - c[2]), over.cross (c[1] - c[0]) };
}

/// A point on a mesh.
struct Spot
{
    int triangle = -1;   ///< none, if negative
    OnTriangle on {};
};

/// A mesh on which one gets about: from a triangle to its neighbours, a few at a time, without a search.
class MeshWalk
{
public:
    explicit MeshWalk (Mesh);   ///< its triangles must name points there are

    const Mesh& mesh() const noexcept { return body; }

    Spot at (int triangle, const Vec3& p) const noexcept { return { triangle, nearestOn (body, triangle, p) }; }

    /// The point nearest to p among the places that are reached from a triangle by coming nearer with each step. On an
    /// edge it stays where it is. [any thread]
    Spot nearest (int from, const Vec3& p) const noexcept;

    /// True if the point lies on the rim of an open mesh and p beyond it: further past the end than above or below.
    bool isBeyondRim (const Spot&, const Vec3& p) const noexcept;

    /// The nearest of all, by looking at each triangle; at few of them if `guess` is one that is near.
    Spot nearestOfAll (const Vec3& p, int guess = -1) const noexcept;

private:
    /// Around a triangle or several, a little wider than they are.
    struct Box
    {
        Vec3 low, high;
    };

    class Reach;

    Mesh body;
    static constexpr std::size_t block = 8;   // triangles; neighbours in a list are mostly neighbours on the mesh

    std::vector<Box> boxes;
    std::vector<Box> blocks;                // around so many triangles one after another
    std::vector<std::array<bool, 3>> rim;   // of each triangle, the edge opposite of each corner has nothing beyond it
    std::vector<int> first, around;         // around[first[i]] … around[first[i + 1]]: the triangles that share point i
};

/// True of a closed mesh whose triangles run clockwise as seen from outside; an open one has no inside.
bool isInsideOut (const Mesh&);

/// At each point the mean of the normals of its triangles, weighted by their angles, out of the body. A point without
/// triangles has none: 0. After Baerentzen & Aanaes 2005.
std::vector<Vec3> normalsOf (const Mesh&);

}   // namespace tactus
