// SPDX-License-Identifier: GPL-3.0-or-later
#include "solid.hpp"

#include <tactus/kit/geometry/mesh_walk.hpp>
#include <tactus/kit/geometry/rotation.hpp>

#include <cmath>
#include <numbers>

namespace tactus::host::scene
{

Solid::Solid (std::shared_ptr<const Surface> s, double sc, const Vec3& o, const Vec3& r) : surface (std::move (s)), scale (sc), origin (o), rotation (r)
{
    if (! surface || ! surface->mesh) return;
    const auto turned = rotationMatrix (rotation);
    for (const auto& p : surface->mesh->points)
    {
        points.push_back (turned * (scale * p) + origin);
        box.add (points.back());
    }
    faces = surface->mesh->triangles;
    normals = normalsOf (Mesh { points, faces });
    findStiffness();
}

/// The winding number of the mesh around a point: 1 inside of a closed mesh, 0 outside. Each triangle adds its solid angle (Van Oosterom & Strackee 1983).
double Solid::turnsAround (const Vec3& p) const noexcept
{
    double sum = 0.0;
    for (const auto& f : faces)
    {
        const Vec3 a = points[at (f[0])] - p, b = points[at (f[1])] - p, c = points[at (f[2])] - p;
        const double la = a.norm(), lb = b.norm(), lc = c.norm();
        sum += std::atan2 (a.dot (b.cross (c)), la * lb * lc + a.dot (b) * lc + b.dot (c) * la + c.dot (a) * lb);
    }
    return sum / (2.0 * std::numbers::pi);
}

bool Solid::contains (const Vec3& p) const noexcept
{
    constexpr double closed = 0.9, well = 0.02;
    constexpr std::size_t most_triangles = 50'000;
    if (faces.size() > most_triangles) return false;
    const auto isIn = [this] (const Vec3& q) {
        return (q.array() > box.low.array()).all() && (q.array() < box.high.array()).all() && turnsAround (q) > closed;
    };
    if (! isIn (p)) return false;
    const double away = 2.0 * well * box.radius();
    for (int axis = 0; axis < 3; ++axis)
        if (! isIn (p + away * Vec3::Unit (axis)) || ! isIn (p - away * Vec3::Unit (axis))) return false;
    return true;
}

void Solid::findStiffness()
{
    constexpr double depth = 1e-3;   // where the laws are compared, in m
    if (surface->curves.empty() || surface->curves[0].size() != points.size()) return;
    double least = std::numeric_limits<double>::infinity(), most = 0.0;
    std::vector<double> forces;
    for (const auto& curves : surface->curves[0])
    {
        forces.push_back (std::log (std::max (1e-9, curves[2](depth))));
        least = std::min (least, forces.back());
        most = std::max (forces.size() == 1 ? forces.back() : most, forces.back());
    }
    if (! (most - least > 1e-3)) return;
    for (const double f : forces)
        stiffness.push_back (static_cast<float> ((f - least) / (most - least)));
}

void Solid::draw (Raster& raster, const Camera& camera, const Paint& paint, const std::vector<Dent>& dents) const
{
    using Corner = Raster::Corner<3>;
    std::vector<Corner> corners (points.size());
    const Ink soft = mixed (paint.material, { 205.0f, 140.0f, 120.0f }, 0.4f), hard = mixed (soft, { 255.0f, 255.0f, 255.0f }, 0.6f);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        Vec3 moved = Vec3::Zero();
        Vec3 normal = normals[i];
        for (const auto& d : dents)
        {
            const double share = d.share (points[i]);
            if (share < 1e-3) continue;
            moved += share * d.by;
            // The gradient of the share tilts the normal.
            const Vec3 away = points[i] - d.at;
            const double fall = -3.0 * share / (Dent::radius * Dent::radius + away.squaredNorm()), along = d.by.dot (normals[i]);
            normal -= along * fall * (away - away.dot (normals[i]) * normals[i]);
        }
        const Ink base = stiffness.empty() ? soft : mixed (soft, hard, stiffness[i]);
        const Ink ink = mixed (base, paint.depth, static_cast<float> (moved.norm() / full_colour_m) * 0.9f);
        const float light = paint.light (static_cast<float> (normal.x()), static_cast<float> (normal.y()), static_cast<float> (normal.z()));
        corners[i] = raster.corner<3> (camera.see (points[i] + moved), camera.near(), { ink[0] * light, ink[1] * light, ink[2] * light });
    }
    const auto shade = [] (const std::array<float, 3>& c) noexcept { return pixelOf (c, 1.0f); };
    for (const auto& f : faces)
        raster.triangle (corners[at (f[0])], corners[at (f[1])], corners[at (f[2])], Raster::Sides::front, shade);
}

}   // namespace tactus::host::scene
