// SPDX-License-Identifier: MIT
#include "placed_surface.hpp"
#include <tactus/kit/math/math.hpp>

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

/// The part of the way to a point at right angles to an edge.
Vec3 awayFrom (const Vec3& start, const Vec3& edge, const Vec3& point)
{
    const Vec3 way = point - start;
    return way - way.dot (edge) / edge.squaredNorm() * edge;
}
}   // namespace

PlacedSurface::PlacedSurface (std::shared_ptr<const Surface> s, double scale, const Vec3& origin, const Vec3& rotation)
    : surface (std::move (s)), mesh_walk (placed (*surface->mesh, scale, origin, rotationMatrix (rotation))), frames (surface->frames)
{
    const auto points = mesh_walk.mesh().points.size(), triangles = mesh_walk.mesh().triangles.size();
    frames.reserve (points);
    squared.reserve (std::max (points, frames.size()));
    elements.reserve (triangles);
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
        auto& element = elements.emplace_back();
        for (int i = 0; i < 3; ++i)
        {
            const Vec3 &first = corners[at ((i + 1) % 3)], &second = corners[at ((i + 2) % 3)], edge = second - first;
            const Vec3 centroid = (corners[0] + corners[1] + corners[2]) / 3.0, rise = awayFrom (first, edge, corners[at (i)]);
            element.feet[at (i)] = std::clamp (edge.dot (centroid - first) / edge.squaredNorm(), 0.0, 1.0);
            const int beside = mesh_walk.beside (t, i);
            if (beside < 0) continue;
            Vec3 sum = direction (rise);
            for (const Vec3& corner : cornersOf (mesh_walk.mesh(), beside))
                if (corner != first && corner != second) sum += direction (awayFrom (first, edge, corner));
            if (sum.norm() < margin (1e-9)) continue;      // level
            constexpr double gentle = 0.2, narrow = 0.4;   // of a slope; of a triangle
            element.roundings[at (i)] = { .rise = -0.5 * rise.norm() * sum, .width = std::clamp (gentle / std::max (0.5 * sum.norm(), gentle), narrow, 1.0) };
        }
    }
    if (frames.size() != mesh_walk.mesh().points.size()) return;
    for (const auto& [a, b, c] : mesh_walk.mesh().triangles)
        even.push_back (frames[at (a)] == frames[at (b)] && frames[at (a)] == frames[at (c)]);
}

}   // namespace tactus
