// SPDX-License-Identifier: MIT
#pragma once

#include "mesh_walk.hpp"
#include "rotation.hpp"
#include "surface.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace tactus
{

/// A surface at its place in the world, and the forces it responds with: eq. (5), (6), (8) and (9) of the chapter, in the
/// symbols of nodes/deform/surface.hpp. Never changes once built; all lengths in m.
class PlacedSurface
{
public:
    PlacedSurface (std::shared_ptr<const Surface>, double scale, const Vec3& origin, const Vec3& rotation);   // [main thread]

    /// Two neighbouring tool shapes, and the share of the second one.
    struct Tool
    {
        int lower = 0, upper = 0;
        double amount = 0.0;
    };

    /// The response of the curves to a tool at p whose contact point is at a spot.
    struct Felt
    {
        Mat3 frame = Mat3::Identity();       ///< rows u^x, u^y, u^z
        Vec3 d = Vec3::Zero();               ///< deflection along these axes, m
        Vec3 f = Vec3::Zero();               ///< force along these axes, N
        std::array<double, 3> energies {};   ///< sum_nu F_i^nu of each corner, J
        double energy = 0.0;                 ///< stored energy, J
    };

    const MeshWalk& walk() const noexcept { return mesh_walk; }

    /// The tool shapes around a number from 0 to the number of shapes - 1. [any thread]
    Tool toolAt (double wanted) const noexcept;

    Felt feel (const Spot&, const Vec3& p, const Tool&) const noexcept;    // [any thread]
    double ratio (const Spot&, double depth) const noexcept;               ///< mu_c: largest sideways deflection of the contact, over its depth
    Vec3 slope (const Spot&, const Felt&, const Vec3& p) const noexcept;   ///< dU/dc of a contact point that follows the tool, N

private:
    Mat3 frameAt (const Spot&) const noexcept;
    void add (Felt&, const Spot&, int tool, double amount) const noexcept;
    const std::array<int, 3>& cornersAt (const Spot& spot) const noexcept { return mesh_walk.mesh().triangles[at (spot.triangle)]; }

    std::shared_ptr<const Surface> surface;
    MeshWalk mesh_walk;
    std::vector<Mat3> frames, squared;   // by node: the frames as given, and the same frames made orthonormal
    std::vector<bool> even;              // by triangle: true if its corners have the same frame
};

//==============================================================================
// Implementation below.

namespace detail
{
/// The frame with u^z of length 1, u^x at right angles to it, and u^y at right angles to both.
inline Mat3 orthonormal (const Mat3& frame) noexcept
{
    const Vec3 z = direction (frame.row (2).transpose());
    Vec3 x = frame.row (0).transpose();
    x = direction (x - x.dot (z) * z);
    Mat3 result;
    result << x.transpose(), z.cross (x).transpose(), z.transpose();
    return result;
}
}   // namespace detail

inline PlacedSurface::Tool PlacedSurface::toolAt (double wanted) const noexcept
{
    const int most = static_cast<int> (surface->curves.size()) - 1;
    const double t = std::clamp (wanted, 0.0, static_cast<double> (most));
    const int lower = static_cast<int> (t);
    return { lower, std::min (lower + 1, most), t - lower };
}

inline PlacedSurface::Felt PlacedSurface::feel (const Spot& spot, const Vec3& p, const Tool& tool) const noexcept
{
    Felt felt;
    felt.frame = frameAt (spot);
    felt.d = felt.frame * (p - spot.on.point);
    add (felt, spot, tool.lower, 1.0 - tool.amount);
    if (tool.amount > 0.0) add (felt, spot, tool.upper, tool.amount);
    for (std::size_t i = 0; i < 3; ++i)
        felt.energy += spot.on.weights[i] * felt.energies[i];
    return felt;
}

/// Eq. (5). On a triangle whose corners have the same frame, such as a flat patch, nothing is interpolated.
inline Mat3 PlacedSurface::frameAt (const Spot& spot) const noexcept
{
    const auto& corners = cornersAt (spot);
    if (even[at (spot.triangle)]) return squared[at (corners[0])];

    Mat3 sum = Mat3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
        sum += spot.on.weights[i] * frames[at (corners[i])];
    return detail::orthonormal (sum);
}

/// Eq. (6): the share of one tool shape in the forces and energies.
inline void PlacedSurface::add (Felt& felt, const Spot& spot, int tool, double amount) const noexcept
{
    const auto& curves = surface->curves[at (tool)];
    const auto& corners = cornersAt (spot);
    const bool alike = curves.size() == 1;
    for (std::size_t i = 0; i < 3; ++i)
    {
        const double share = alike ? amount : amount * spot.on.weights[i];
        const Surface::Curves& of = curves[alike ? 0 : at (corners[i])];
        double energy = 0.0;
        for (int axis = 0; axis < 3; ++axis)
        {
            const double d = axis < 2 ? std::abs (felt.d[axis]) : felt.d[axis];
            const auto [force, stored] = of[at (axis)].at (d);
            felt.f[axis] += share * (felt.d[axis] < 0.0 ? -force : force);
            energy += stored;
        }
        if (alike)
        {
            for (double& all : felt.energies)
                all += amount * energy;
            return;
        }
        felt.energies[i] += amount * energy;
    }
}

inline double PlacedSurface::ratio (const Spot& spot, double depth) const noexcept
{
    const auto& mu = surface->mu;
    if (mu.empty()) return 0.0;
    if (mu.size() == 1) return mu[0](depth);
    const auto& corners = cornersAt (spot);
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += spot.on.weights[i] * mu[at (corners[i])](depth);
    return sum;
}

/// The slope over the triangle; or, where a crease or the rim holds the contact point, along that edge.
inline Vec3 PlacedSurface::slope (const Spot& spot, const Felt& felt, const Vec3& p) const noexcept
{
    const auto& [triangle, on] = spot;
    const auto corners = cornersOf (mesh_walk.mesh(), triangle);
    const auto gradients = gradientsOf (corners);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
        sum += felt.energies[i] * gradients[i];

    const Vec3 away = p - on.point, normal = direction (areaNormal (corners));
    const Vec3 sideways = away - away.dot (normal) * normal;
    if (sideways.norm() <= 1e-9 * away.norm()) return sum;
    for (std::size_t i = 0; i < 3; ++i)
        if (on.weights[i] == 0.0 && on.weights[(i + 1) % 3] > 0.0 && on.weights[(i + 2) % 3] > 0.0)
        {
            const Vec3 edge = direction (corners[(i + 2) % 3] - corners[(i + 1) % 3]);
            return edge.dot (sum) * edge;
        }
    return Vec3::Zero();
}

}   // namespace tactus
