// SPDX-License-Identifier: MIT
#pragma once

#include "rotation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace tactus
{

/// A face, edge or tip of a tool: where it looks, and which tool a body meets in it.
struct ToolFace
{
    Vec3 direction = -Vec3::UnitZ();   ///< out of the tool, of length 1, in the frame of the tool
    double tool = 0.0;                 ///< its number, as deform.surface counts tools
};

/// The part of a leaning tool that touches.
struct ToolTilt
{
    double tool = 0.0;          ///< between the numbers of the faces
    Vec3 turn = Vec3::Zero();   ///< gradient of `tool` when the tool turns, about the axes of the world, in 1/rad
};

inline constexpr std::size_t most_faces = 8;

/// The share of each face of a tool in a touch, and so which tool the body meets:
///
///     q_i  = 1 - a_i . m                      a_i: direction of face i in the world; m: unit vector into the body
///     w_i  = (1 / q_i) / sum_j (1 / q_j)      shares, convex
///     tool = sum_i w_i tool_i
///
/// A face that looks straight into the body has all the share. Near that, the share of the others grows with the square of the angle, so the
/// gradient is 0 at each face, and continuous everywhere. This is inverse-distance interpolation (Shepard 1968) on the sphere. Products
/// replace the fractions, so q_i = 0 is no exception. No two faces may look in the same direction; those beyond `most_faces` are ignored.
/// [any thread]
inline ToolTilt tiltOf (std::span<const ToolFace> faces, const Mat3& rotation, const Vec3& into_body) noexcept
{
    const std::size_t n = std::min (faces.size(), most_faces);
    std::array<double, most_faces> q {}, share {};
    std::array<Vec3, most_faces> turns {};   // dq_i / d rotation
    for (std::size_t i = 0; i < n; ++i)
    {
        const Vec3 a = rotation * faces[i].direction;
        q[i] = std::max (0.0, 1.0 - a.dot (into_body));
        turns[i] = -a.cross (into_body);
    }
    const auto product = [&] (std::size_t but, std::size_t and_but) {
        double all = 1.0;
        for (std::size_t i = 0; i < n; ++i)
            if (i != but && i != and_but) all *= q[i];
        return all;
    };
    double sum = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
        share[i] = product (i, i);
        sum += share[i];
        mean += share[i] * faces[i].tool;
    }
    if (! (sum > 0.0)) return { .tool = n > 0 ? faces[0].tool : 0.0 };

    ToolTilt tilt { .tool = mean / sum };
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            if (i != j) tilt.turn += (faces[i].tool - tilt.tool) / sum * product (i, j) * turns[j];
    return tilt;
}

/// dU / d tool, in J: what turning the tool costs. `energy` is the stored energy U of a contact for a tool of this number, from 0 to `most`, with
/// the tool and its anchor where they are. A tool that turns while it touches feels the torque - dU/d tool * turn, so that the hand pays for
/// the change of U. Between two numbers U is smooth; where the number is whole its slope may step, and this is the one above, or of the last two
/// tools. [any thread]
template <typename Energy>
double toolSlope (double tool, double most, const Energy& energy) noexcept
{
    constexpr double step = 1e-3;
    const double t = std::clamp (tool, 0.0, most), lower = std::max (0.0, std::min (std::floor (t), most - 1.0));
    const double a = std::max (lower, t - step), b = std::min ({ lower + 1.0, most, t + step });
    return b > a ? (energy (b) - energy (a)) / (b - a) : 0.0;
}

}   // namespace tactus
