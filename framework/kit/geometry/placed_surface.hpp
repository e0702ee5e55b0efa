// SPDX-License-Identifier: MIT
#pragma once

#include "mesh_walk.hpp"
#include "rotation.hpp"
#include "smooth_weights.hpp"
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

    /// What a tool is made of: shapes, and the share of each. The sum of the shares is 1.
    struct Share
    {
        int shape = 0;
        double amount = 0.0;
    };
    struct Tool
    {
        std::vector<Share> shares;   ///< the first `count` are used
        int count = 0;
        bool smooth = false;   ///< the response is interpolated with smooth weights instead of barycentric ones
    };

    /// The response of the curves to a tool at p whose contact point is at a spot.
    struct ContactSample
    {
        Mat3 frame = Mat3::Identity();       ///< rows u^x, u^y, u^z
        Vec3 d = Vec3::Zero();               ///< deflection along these axes, m
        Vec3 f = Vec3::Zero();               ///< force along these axes, N
        std::array<double, 3> energies {};   ///< sum_nu F_i^nu of each corner, J
        double energy = 0.0;                 ///< stored energy, J
    };

    const MeshWalk& walk() const noexcept { return mesh_walk; }

    Tool noTool() const { return { .shares = std::vector<Share> (surface->curves.size()) }; }   ///< with room for every shape

    /// Writes the shares of the tool with this number, at a spot, into `tool`, which must come from noTool(). The number goes from 0 to
    /// the number of tools - 1; a fraction blends two tools. [any thread]
    void choose (double number, const Spot&, Tool& tool) const noexcept;

    ContactSample feel (const Spot&, const Vec3& p, const Tool&) const noexcept;                 // [any thread]
    double ratio (const Spot&, double depth, const Tool&) const noexcept;                        ///< mu_c: largest sideways deflection of the contact / its depth
    Vec3 slope (const Spot&, const ContactSample&, const Vec3& p, const Tool&) const noexcept;   ///< dU/dc for a contact point that follows the tool, in N

private:
    using Weights = std::array<double, 3>;

    Mat3 frameAt (const Spot&, const Weights&, const Tool&) const noexcept;
    std::array<Vec3, 3> gradientsAt (const Spot&, const Tool&) const noexcept;
    double shareOf (int shape, int tool, const Spot&) const noexcept;
    void add (ContactSample&, const Spot&, const Weights&, int shape, double amount) const noexcept;
    const std::array<int, 3>& cornersAt (const Spot& spot) const noexcept { return mesh_walk.mesh().triangles[at (spot.triangle)]; }

    std::shared_ptr<const Surface> surface;
    MeshWalk mesh_walk;
    std::vector<Mat3> frames, squared;   // by node, or by shape, then node: the frames as given; the same frames made orthonormal
    std::vector<Weights> feet;           // by triangle, then corner: where the foot of the centroid is on the edge opposite the corner, 0 to 1
    std::vector<bool> even;              // by triangle: true if its corners have the same frame; empty if the shapes have their own frames
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

/// Eq. (8).
inline void PlacedSurface::choose (double number, const Spot& spot, Tool& tool) const noexcept
{
    const int shapes = static_cast<int> (surface->curves.size());
    const int most = (surface->weights.empty() ? shapes : static_cast<int> (surface->weights.size())) - 1;
    const double t = std::clamp (number, 0.0, static_cast<double> (most));
    const int lower = static_cast<int> (t), upper = std::min (lower + 1, most);
    const double second = t - lower;

    tool.count = 0;
    for (int shape = 0; shape < shapes; ++shape)
    {
        const double amount = (1.0 - second) * shareOf (shape, lower, spot) + (second > 0.0 ? second * shareOf (shape, upper, spot) : 0.0);
        if (amount > 0.0) tool.shares[at (tool.count++)] = { shape, amount };
    }
}

/// The share of a shape in a tool. Where the shares differ from node to node, they are interpolated.
inline double PlacedSurface::shareOf (int shape, int tool, const Spot& spot) const noexcept
{
    if (surface->weights.empty()) return shape == tool ? 1.0 : 0.0;
    const auto& nodes = surface->weights[at (tool)];
    if (nodes.size() == 1) return nodes[0][at (shape)];
    const auto& corners = cornersAt (spot);
    double sum = 0.0;
    for (std::size_t i = 0; i < 3; ++i)
        sum += spot.on.weights[i] * nodes[at (corners[i])][at (shape)];
    return sum;
}

inline PlacedSurface::ContactSample PlacedSurface::feel (const Spot& spot, const Vec3& p, const Tool& tool) const noexcept
{
    ContactSample felt;
    const Weights n = tool.smooth ? smoothWeights (spot.on.weights, feet[at (spot.triangle)]) : spot.on.weights;
    felt.frame = frameAt (spot, n, tool);
    felt.d = felt.frame * (p - spot.on.point);
    for (int i = 0; i < tool.count; ++i)
        add (felt, spot, n, tool.shares[at (i)].shape, tool.shares[at (i)].amount);
    for (std::size_t i = 0; i < 3; ++i)
        felt.energy += n[i] * felt.energies[i];
    return felt;
}

/// Eq. (5). On a triangle whose corners have the same frame, such as a flat patch, nothing is interpolated. If the shapes have their
/// own frames, these are also interpolated by the shares of the shapes.
inline Mat3 PlacedSurface::frameAt (const Spot& spot, const Weights& n, const Tool& tool) const noexcept
{
    const auto& corners = cornersAt (spot);
    if (! even.empty() && even[at (spot.triangle)]) return squared[at (corners[0])];

    const auto interpolated = [&] (std::size_t first) {
        Mat3 sum = Mat3::Zero();
        for (std::size_t i = 0; i < 3; ++i)
            sum += n[i] * frames[first + at (corners[i])];
        return sum;
    };
    if (! even.empty()) return detail::orthonormal (interpolated (0));

    Mat3 sum = Mat3::Zero();
    for (int i = 0; i < tool.count; ++i)
        sum += tool.shares[at (i)].amount * interpolated (at (tool.shares[at (i)].shape) * mesh_walk.mesh().points.size());
    return detail::orthonormal (sum);
}

/// Eq. (6) and (9): adds the share of one shape to the forces and energies.
inline void PlacedSurface::add (ContactSample& felt, const Spot& spot, const Weights& n, int shape, double amount) const noexcept
{
    const auto& curves = surface->curves[at (shape)];
    const auto& corners = cornersAt (spot);
    const bool alike = curves.size() == 1;
    for (std::size_t i = 0; i < 3; ++i)
    {
        const double share = alike ? amount : amount * n[i];
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

inline double PlacedSurface::ratio (const Spot& spot, double depth, const Tool& tool) const noexcept
{
    const auto& mu = surface->mu;
    if (mu.empty()) return 0.0;
    if (mu.size() == 1) return mu[0](depth);
    const auto& corners = cornersAt (spot);
    const auto interpolated = [&] (std::size_t first) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
            sum += spot.on.weights[i] * mu[first + at (corners[i])](depth);
        return sum;
    };
    const auto nodes = mesh_walk.mesh().points.size();
    if (mu.size() == nodes) return interpolated (0);

    double sum = 0.0;
    for (int i = 0; i < tool.count; ++i)
        sum += tool.shares[at (i)].amount * interpolated (at (tool.shares[at (i)].shape) * nodes);
    return sum;
}

/// The gradients of the weights of the corners.
inline std::array<Vec3, 3> PlacedSurface::gradientsAt (const Spot& spot, const Tool& tool) const noexcept
{
    const auto corners = cornersOf (mesh_walk.mesh(), spot.triangle);
    const auto barycentric = gradientsOf (corners);
    if (! tool.smooth) return barycentric;

    constexpr double h = 1e-5;   // step of the central difference, in barycentric coordinates
    std::array<Vec3, 3> sum { Vec3::Zero(), Vec3::Zero(), Vec3::Zero() };
    for (std::size_t k = 1; k < 3; ++k)   // changes coordinate k, and coordinate 0 by the opposite amount
    {
        Weights more = spot.on.weights, less = more;
        more[k] += h;
        more[0] -= h;
        less[k] -= h;
        less[0] += h;
        const auto after = smoothWeights (more, feet[at (spot.triangle)]), before = smoothWeights (less, feet[at (spot.triangle)]);
        for (std::size_t i = 0; i < 3; ++i)
            sum[i] += (after[i] - before[i]) / (2.0 * h) * barycentric[k];
    }
    return sum;
}

/// The slope over the triangle; or, where a crease or the rim holds the contact point, along that edge.
inline Vec3 PlacedSurface::slope (const Spot& spot, const ContactSample& felt, const Vec3& p, const Tool& tool) const noexcept
{
    const auto& [triangle, on] = spot;
    const auto corners = cornersOf (mesh_walk.mesh(), triangle);
    const auto gradients = gradientsAt (spot, tool);
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i)
        sum += felt.energies[i] * gradients[i];

    const Vec3 away = p - on.point, normal = direction (areaNormal (corners));
    const Vec3 sideways = away - away.dot (normal) * normal;
    if (sideways.norm() <= margin (1e-9) * away.norm()) return sum;
    for (std::size_t i = 0; i < 3; ++i)
        if (on.weights[i] == 0.0 && on.weights[(i + 1) % 3] > 0.0 && on.weights[(i + 2) % 3] > 0.0)
        {
            const Vec3 edge = direction (corners[(i + 2) % 3] - corners[(i + 1) % 3]);
            return edge.dot (sum) * edge;
        }
    return Vec3::Zero();
}

}   // namespace tactus
