// SPDX-License-Identifier: MIT
#pragma once

#include "mirrored_grid.hpp"

namespace tactus
{

/// A smooth surface through the points of a grid: a B-spline of degree 5, with continuous derivatives up to the fourth.
///
/// Source: Unser 1999. Beyond the grid the surface is continued by mirroring.
class SplineSurface
{
public:
    SplineSurface() = default;
    explicit SplineSurface (MirroredGrid points);   ///< [main thread]

    struct Point
    {
        double height = 0.0, slope_x = 0.0, slope_y = 0.0;
    };

    /// [any thread]
    Point operator() (double x, double y) const noexcept;

    /// An upper bound on the second derivative in any direction, in units of the heights per m^2. [main thread]
    double largestCurvature() const noexcept;

private:
    MirroredGrid weights { {}, {}, { 0.0 } };   // by grid point: the weight of its B-spline
};

}   // namespace tactus
