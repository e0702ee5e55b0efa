// SPDX-License-Identifier: MIT
#include "placed_surface.hpp"

#include <utility>

namespace tactus
{

namespace
{
Mesh placed (const Mesh& mesh, double scale, const Vec3& origin, const Mat3& turn)
{
    Mesh result = mesh;
    for (auto& p : result.points)
        p = origin + turn * (scale * p);
    return result;
}

/// The frame with this u^z that results from turning (x, -y, -z) by the shortest rotation, so that neighbours get similar frames.
Mat3 frameInto (const Vec3& z)
{
    Mat3 frame;
    frame << Vec3::UnitX().transpose(), -Vec3::UnitY().transpose(), -Vec3::UnitZ().transpose();
    return z.isZero (0.0) ? frame : Mat3 { frame * shortestRotation (-Vec3::UnitZ(), z).toRotationMatrix().transpose() };
}
}   // namespace

PlacedSurface::PlacedSurface (std::shared_ptr<const Surface> s, double scale, const Vec3& origin, const Vec3& rotation)
    : surface (std::move (s)), mesh_walk (placed (*surface->mesh, scale, origin, rotationMatrix (rotation))), frames (surface->frames)
{
    const auto points = mesh_walk.mesh().points.size(), triangles = mesh_walk.mesh().triangles.size();
    frames.reserve (points);
    squared.reserve (std::max (points, frames.size()));
    feet.reserve (triangles);
    even.reserve (triangles);
    if (frames.empty())
        for (const auto& n : normalsOf (mesh_walk.mesh()))
            frames.push_back (frameInto (-n));
    else
        for (auto& f : frames)
            f *= rotationMatrix (rotation).transpose();

    for (const auto& f : frames)
        squared.push_back (detail::orthonormal (f));
    for (int t = 0; t < mesh_walk.mesh().size(); ++t)
    {
        const auto corners = cornersOf (mesh_walk.mesh(), t);
        auto& foot = feet.emplace_back();
        for (std::size_t i = 0; i < 3; ++i)
        {
            const Vec3 edge = corners[(i + 2) % 3] - corners[(i + 1) % 3], centroid = (corners[0] + corners[1] + corners[2]) / 3.0;
            foot[i] = std::clamp (edge.dot (centroid - corners[(i + 1) % 3]) / edge.squaredNorm(), 0.0, 1.0);
        }
    }
    if (frames.size() != mesh_walk.mesh().points.size()) return;
    for (const auto& [a, b, c] : mesh_walk.mesh().triangles)
        even.push_back (frames[at (a)] == frames[at (b)] && frames[at (a)] == frames[at (c)]);
}

}   // namespace tactus
