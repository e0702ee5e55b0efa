// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

namespace tactus::host
{

/// The values of an axis, from low to high, and whether a value between two of them may be asked for, which moves a boundary to where it is.
struct GridAxis
{
    std::vector<double> values;
    bool is_cheap = true;
};

/// The line around the region of a plane in which a function is below 0; nan on both sides separates its pieces.
struct Boundary
{
    std::vector<double> x, y;
};

/// Finds the boundary on a grid. `f` gives nan where nothing is known; no boundary is drawn there. Along a cheap axis the line is within a hundredth of
/// a step; along another one it is interpolated.
Boundary boundaryOf (const std::function<double (double x, double y)>& f, const GridAxis& x, const GridAxis& y);

}   // namespace tactus::host
