// SPDX-License-Identifier: MIT
#pragma once

#include "nearest_triangle.hpp"

#include <Eigen/Geometry>

#include <span>

namespace tactus
{

using Corners = std::array<Vec3, 3>;

inline Corners cornersOf (const Mesh& mesh, int triangle) noexcept
{
    return { mesh.corner (triangle, 0), mesh.corner (triangle, 1), mesh.corner (triangle, 2) };
}

/// The outward normal of a triangle. Its length is twice the area.
inline Vec3 areaNormal (const Corners& c) noexcept { return (c[1] - c[0]).cross (c[2] - c[0]); }

/// The gradients of the barycentric weights over the triangle, in 1/m.
inline std::array<Vec3, 3> gradientsOf (const Corners& c) noexcept
{
    const Vec3 n = areaNormal (c), over = n / n.squaredNorm();
    return { over.cross (c[2] - c[1]), over.cross (c[0] - c[2]), over.cross (c[1] - c[0]) };
}

/// A point on a mesh.
struct Spot
{
    int triangle = -1;   ///< negative: none
    OnTriangle on {};
};

/// A mesh that a contact point moves over: from a triangle to its neighbours, a few at a time, without a search.
class MeshWalk
{
public:
    explicit MeshWalk (Mesh);   ///< all indices of its triangles must be valid

    const Mesh& mesh() const noexcept { return body; }

    Spot spotOn (int triangle, const Vec3& p) const noexcept { return { triangle, nearestOn (body, triangle, p) }; }

    /// Walks from a triangle towards p while each step comes nearer, and returns the spot where the walk ends. If that is on an
    /// edge, the spot belongs to the triangle that the walk came from. [any thread]
    Spot nearest (int from, const Vec3& p) const noexcept;

    /// The first place where the straight line between two points crosses the mesh from outside to inside; no triangle if there is none. A
    /// crossing at an edge is never missed because of rounding. [any thread]
    Spot entered (const Vec3& from, const Vec3& to) const noexcept;

    /// The triangle on the other side of the edge opposite a corner, 0 to 2; negative at the rim of an open mesh. [any thread]
    int beside (int triangle, int corner) const noexcept { return neighbours[at (triangle)][at (corner)]; }

    /// The triangles that have a point. [any thread]
    std::span<const int> around (int point) const noexcept
    {
        return { sharing.data() + first[at (point)], static_cast<std::size_t> (first[at (point + 1)] - first[at (point)]) };
    }

    /// The same spot, given on the triangle on the other side of the edge opposite a corner, which must have one. [any thread]
    Spot across (const Spot&, int corner) const noexcept;

    /// The nearest point of the whole mesh. Looks at few triangles if `guess` is a nearby one. [any thread]
    Spot nearestOfAll (const Vec3& p, int guess = -1) const noexcept;

private:
    /// Encloses one triangle or several, with a little slack.
    struct Box
    {
        Vec3 low, high;
    };

    class Reach;

    Mesh body;
    static constexpr int block = 8;   // in triangles; triangles that follow each other in a list are mostly neighbours on the mesh

    std::vector<Box> boxes;
    std::vector<Box> blocks;                      // each encloses `block` successive triangles
    std::vector<std::array<int, 3>> neighbours;   // by triangle, then corner: see beside()
    std::vector<int> first, sharing;              // the triangles that share point i: from sharing[first[i]] to just before sharing[first[i + 1]]
};

/// The outward normal at each point: the mean of the normals of its triangles, weighted by their angles there. 0 for a point
/// without triangles. Source: Baerentzen & Aanaes 2005.
std::vector<Vec3> normalsOf (const Mesh&);

}   // namespace tactus
