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

    /// A shape that a tool is made of, and its share. The sum of the shares of a tool is 1.
    struct Share
    {
        int shape = 0;
        double amount = 0.0;
    };
    struct Tool
    {
        std::vector<Share> shares;   ///< the first `count` are used
        int count = 0;
    };

    /// The response of the curves to a tool whose foot is at a spot.
    struct ContactSample
    {
        Mat3 frame = Mat3::Identity();                                    ///< rows u^x, u^y, u^z
        Vec3 place = Vec3::Zero();                                        ///< the spot on the rounded body, m
        Eigen::Matrix<double, 2, 1, Eigen::DontAlign> off { 0.0, 0.0 };   ///< the tool beside u^z through the place, along u^x and u^y; 0 at a foot, m
        Vec3 d = Vec3::Zero();                                            ///< sideways stretch along u^x and u^y, and depth, m
        Vec3 f = Vec3::Zero();                                            ///< force along these axes, N
        Vec3 rise = Vec3::Zero();                                         ///< gradient of the depth in the tool's position, with the spot fixed
        double energy = 0.0;                                              ///< stored energy, J
    };

    const MeshWalk& walk() const noexcept { return mesh_walk; }

    Tool noTool() const { return { .shares = std::vector<Share> (surface->curves.size()) }; }   ///< with room for every shape

    /// Writes the shares of the tool with this number, at a spot, into `tool`, which must come from noTool(). The number goes from 0 to
    /// the number of tools - 1; a fraction blends two tools. [any thread]
    void choose (double number, const Spot&, Tool& tool) const noexcept;

    Mat3 frameAt (const Spot&, const Tool&) const noexcept;   // [any thread]

    /// The place of a spot if the body is rounded off between its edges, so that a foot crosses an edge without a turn. [any thread]
    Vec3 placeOf (const Spot&) const noexcept;

    /// The response that a tool at p feels with its foot at a spot, stretched from an anchor; null: not stretched. [any thread]
    ContactSample feel (const Spot&, const Vec3& p, const Vec3* anchor, const Tool&) const noexcept;

    double ratio (const Spot&, double depth, const Tool&) const noexcept;   ///< mu_c: largest sideways stretch of the contact / its depth

private:
    using Weights = std::array<double, 3>;

    /// The rounding of the body beside an edge of a triangle.
    struct Rounding
    {
        Vec3 rise { 0.0, 0.0, 0.0 };   // out of the body, per barycentric weight; 0 if both triangles are level, or at the rim
        double width = 1.0;            // barycentric
    };
    struct Element
    {
        Weights feet;                        // by corner: where the foot of the centroid is on the edge opposite the corner, 0 to 1
        std::array<Rounding, 3> roundings;   // by corner: beside the edge opposite the corner
    };

    Weights weightsAt (const Spot& spot) const noexcept { return smoothWeights (spot.on.weights, elements[at (spot.triangle)].feet); }
    Mat3 frameAt (const Spot&, const Weights&, const Tool&) const noexcept;
    double shareOf (int shape, int tool, const Spot&) const noexcept;
    void add (ContactSample&, const Spot&, const Weights&, int shape, double amount) const noexcept;
    const std::array<int, 3>& cornersAt (const Spot& spot) const noexcept { return mesh_walk.mesh().triangles[at (spot.triangle)]; }

    std::shared_ptr<const Surface> surface;
    MeshWalk mesh_walk;
    std::vector<Mat3> frames, squared;   // by node, or by shape, then node: the frames as given; the same frames made orthonormal
    std::vector<Element> elements;       // by triangle
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

inline PlacedSurface::ContactSample PlacedSurface::feel (const Spot& spot, const Vec3& p, const Vec3* anchor, const Tool& tool) const noexcept
{
    ContactSample felt;
    const Weights n = weightsAt (spot);
    felt.frame = frameAt (spot, n, tool);
    felt.place = placeOf (spot);
    const Vec3 away = felt.frame * (p - felt.place);
    felt.off = away.head<2>();
    felt.d.z() = away.z();
    felt.rise = felt.frame.row (2).transpose();
    const Vec3 normal = areaNormal (cornersOf (mesh_walk.mesh(), spot.triangle));
    if (const double facing = normal.dot (felt.rise); felt.place != spot.on.point && facing < 0.0)
    {
        // The rounding fades out towards the triangle, so that nothing is felt above it.
        const double w = normal.dot (p - spot.on.point) / facing, b = away.z() - w, bb = 4.0 * b * b, all = w * w + bb;   // w: depth below the triangle
        if (! (all > 0.0)) return felt;
        const Vec3 across = normal / facing - felt.rise;
        felt.d.z() = w + b * w * w / all;
        felt.rise += across + 2.0 * b * bb * w / (all * all) * (felt.rise + across) - w * w * (w * w - bb) / (all * all) * across;
    }
    if (anchor) felt.d.head<2>() = (felt.frame * (felt.place - *anchor)).head<2>();
    for (int i = 0; i < tool.count; ++i)
        add (felt, spot, n, tool.shares[at (i)].shape, tool.shares[at (i)].amount);
    return felt;
}

inline Vec3 PlacedSurface::placeOf (const Spot& spot) const noexcept
{
    const auto& l = spot.on.weights;
    const auto& roundings = elements[at (spot.triangle)].roundings;
    const Weights near { l[1] * l[1] * l[2] * l[2], l[2] * l[2] * l[0] * l[0], l[0] * l[0] * l[1] * l[1] };   // the edges, by how near they are
    const double all = near[0] + near[1] + near[2];
    Vec3 place = spot.on.point;
    if (! (all > 0.0)) return place;
    for (std::size_t i = 0; i < 3; ++i)
        if (const double inside = 1.0 - l[i] / roundings[i].width; inside > 0.0) place += near[i] / all * l[i] * inside * inside * roundings[i].rise;
    return place;
}

inline Mat3 PlacedSurface::frameAt (const Spot& spot, const Tool& tool) const noexcept { return frameAt (spot, weightsAt (spot), tool); }

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

/// Eq. (6) and (9): adds the share of one shape to the forces and the energy.
inline void PlacedSurface::add (ContactSample& felt, const Spot& spot, const Weights& n, int shape, double amount) const noexcept
{
    const auto& curves = surface->curves[at (shape)];
    const auto& corners = cornersAt (spot);
    const bool alike = curves.size() == 1;
    for (std::size_t i = 0; i < (alike ? 1 : 3); ++i)
    {
        const double share = alike ? amount : amount * n[i];
        const Surface::Curves& of = curves[alike ? 0 : at (corners[i])];
        for (int axis = 0; axis < 3; ++axis)
        {
            const double d = axis < 2 ? std::abs (felt.d[axis]) : felt.d[axis];
            const auto [force, stored] = of[at (axis)].at (d);
            felt.f[axis] += share * (felt.d[axis] < 0.0 ? -force : force);
            felt.energy += share * stored;
        }
    }
}

inline double PlacedSurface::ratio (const Spot& spot, double depth, const Tool& tool) const noexcept
{
    const auto& mu = surface->mu;
    if (mu.empty()) return 0.0;
    if (mu.size() == 1) return mu[0](depth);
    const auto& corners = cornersAt (spot);
    const Weights n = weightsAt (spot);
    const auto interpolated = [&] (std::size_t first) {
        double sum = 0.0;
        for (std::size_t i = 0; i < 3; ++i)
            sum += n[i] * mu[first + at (corners[i])](depth);
        return sum;
    };
    const auto nodes = mesh_walk.mesh().points.size();
    if (mu.size() == nodes) return interpolated (0);

    double sum = 0.0;
    for (int i = 0; i < tool.count; ++i)
        sum += tool.shares[at (i)].amount * interpolated (at (tool.shares[at (i)].shape) * nodes);
    return sum;
}

}   // namespace tactus
