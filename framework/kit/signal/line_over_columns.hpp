// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace tactus
{

/// A straight line from a to b in a plane that is divided into upright columns at equal distances h. Column j is centred at x = j h.
///
/// Columns overlap: column j weighs the line above it by its hat function, which is 1 at x = j h and falls to 0 at a distance of h.
/// The hats of neighbours add up to 1. So h times the sum of all shares is exactly the length of the line along x, wherever the line
/// begins, and the shares change smoothly when the line moves (linear finite elements).
struct LineOverColumns
{
    double x[2] {}, depth[2] {};   ///< of a and b, in m

    /// The part of the line above one column.
    struct Part
    {
        double share = 0.0;   ///< 1: the line is above the whole column
        double depth = 0.0;   ///< mean depth of the line, in m
        double along = 0.0;   ///< mean position on the line: 0 at a, 1 at b
        double hat[2] {};     ///< the hat function at a and b

        explicit operator bool() const noexcept { return share > margin (1e-9); }
    };

    double length() const noexcept { return x[1] - x[0]; }
    double sign() const noexcept { return x[1] < x[0] ? -1.0 : 1.0; }
    double slope() const noexcept { return length() != 0.0 ? (depth[1] - depth[0]) / length() : 0.0; }

    /// The columns that can lie below the line: first() to end() - 1.
    std::int32_t first (double h) const noexcept { return static_cast<std::int32_t> (std::floor (std::min (x[0], x[1]) / h)); }
    std::int32_t end (double h) const noexcept { return static_cast<std::int32_t> (std::ceil (std::max (x[0], x[1]) / h)) + 1; }

    Part over (double column, double h) const noexcept
    {
        const double a = x[0] / h - column, b = x[1] / h - column;
        if (std::min (a, b) <= -1.0 && std::max (a, b) >= 1.0)
        {
            const double along = a / (a - b);
            return { .share = 1.0, .depth = depth[0] + along * (depth[1] - depth[0]), .along = along };
        }

        // For h = 1: the hat function around 0, its integral from -1, and the integral of u times the hat function.
        const auto hat = [] (double u) { return std::max (0.0, 1.0 - std::abs (u)); };
        const auto area = [&] (double u) { return u < 0.0 ? 0.5 * hat (u) * hat (u) : 1.0 - 0.5 * hat (u) * hat (u); };
        const auto moment = [] (double u) {
            const double r = std::min (1.0, std::abs (u));
            return r * r * (0.5 - r / 3.0) - 1.0 / 6.0;
        };

        const double covered = area (b) - area (a);
        Part part { .share = std::abs (covered), .hat = { hat (a), hat (b) } };
        if (! part) return part;
        part.along = std::clamp (((moment (b) - moment (a)) / covered - a) / (b - a), 0.0, 1.0);
        part.depth = depth[0] + part.along * (depth[1] - depth[0]);
        return part;
    }
};

}   // namespace tactus
