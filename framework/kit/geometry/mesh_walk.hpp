// SPDX-License-Identifier: MIT
#pragma once

#include "nearest_triangle.hpp"

#include <Eigen/Geometry>

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
    Spot nearest (int from, const Vec3& p) const noexcept { return nearestAmong (from, p, nullptr); }

    /// The same, but the walk stays on triangles through which a move in the direction of `way` enters the body. [any thread]
    Spot nearestFacing (int from, const Vec3& p, const Vec3& way) const noexcept { return nearestAmong (from, p, &way); }

    /// The first triangle that the straight line between two points crosses from outside to inside; negative if there is none. A
    /// crossing at an edge is never missed because of rounding. [any thread]
    int entered (const Vec3& from, const Vec3& to) const noexcept;

    /// Calls visit (triangle) for the triangles around a spot: at its corner, at both ends of its edge, or at all three corners of
    /// its triangle. The triangle of the spot is visited too, and any triangle may be visited more than once. [any thread]
    template <typename Visit>
    void around (const Spot&, Visit visit) const;

    /// True if the mesh has a rim: an edge that belongs to one triangle only.
    bool isOpen() const noexcept { return is_open; }

    /// True if the spot lies on the rim of an open mesh and p is beyond it: p is farther out past the rim than it is above or
    /// below the mesh. [any thread]
    bool isBeyondRim (const Spot&, const Vec3& p) const noexcept;

    /// The nearest point of the whole mesh. Looks at few triangles if `guess` is a nearby one. [any thread]
    Spot nearestOfAll (const Vec3& p, int guess = -1) const noexcept;

private:
    /// Encloses one triangle or several, with a little slack.
    struct Box
    {
        Vec3 low, high;
    };

    class Reach;

    Spot nearestAmong (int from, const Vec3& p, const Vec3* way) const noexcept;

    Mesh body;
    static constexpr int block = 8;   // in triangles; triangles that follow each other in a list are mostly neighbours on the mesh

    std::vector<Box> boxes;
    std::vector<Box> blocks;                // each encloses `block` successive triangles
    std::vector<std::array<bool, 3>> rim;   // by triangle, then corner: true if the edge opposite that corner belongs to no other triangle
    std::vector<int> first, sharing;        // the triangles that share point i: from sharing[first[i]] to just before sharing[first[i + 1]]
    bool is_open = false;
};

template <typename Visit>
void MeshWalk::around (const Spot& spot, Visit visit) const
{
    for (std::size_t c = 0; c < 3; ++c)
    {
        if (spot.on.weights[c] <= 0.0) continue;
        const auto corner = at (body.triangles[at (spot.triangle)][c]);
        for (int i = first[corner]; i < first[corner + 1]; ++i)
            visit (sharing[at (i)]);
    }
}

/// True for a closed mesh whose triangles run clockwise as seen from outside. An open mesh has no inside.
bool isInsideOut (const Mesh&);

/// The outward normal at each point: the mean of the normals of its triangles, weighted by their angles there. 0 for a point
/// without triangles. Source: Baerentzen & Aanaes 2005.
std::vector<Vec3> normalsOf (const Mesh&);

}   // namespace tactus
