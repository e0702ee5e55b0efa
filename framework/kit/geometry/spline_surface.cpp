// SPDX-License-Identifier: MIT
#include "spline_surface.hpp"
#include <tactus/kit/math/math.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tactus
{

namespace
{
/// The six B-splines that are nonzero at a position on an axis: their weights and slopes there.
struct Reach
{
    std::array<int, 6> index {};
    std::array<double, 6> weight {}, slope {};
};

Reach reach (const MirroredAxis& axis, double place) noexcept
{
    if (axis.intervals == 0) return { .weight { 1.0 } };
    const double u = math::fmod (place, 2.0 * axis.intervals * axis.spacing) / axis.spacing, floor = std::floor (u);
    const double t = u - floor, s = 1.0 - t;
    const auto near = [] (double v) { return (66.0 + v * v * (-60.0 + v * v * (30.0 - 10.0 * v))) / 120.0; };
    const auto far = [] (double v) { return (26.0 + v * (-50.0 + v * (20.0 + v * (20.0 + v * (-20.0 + 5.0 * v))))) / 120.0; };
    const auto near_slope = [] (double v) { return v * (-120.0 + v * v * (120.0 - 50.0 * v)) / 120.0; };
    const auto far_slope = [] (double v) { return (-50.0 + v * (40.0 + v * (60.0 + v * (-80.0 + 25.0 * v)))) / 120.0; };
    Reach r {
        .weight { s * s * s * s * s / 120.0, far (t), near (t), near (s), far (s), t * t * t * t * t / 120.0 },
        .slope { -s * s * s * s / 24.0, far_slope (t), near_slope (t), -near_slope (s), -far_slope (s), t * t * t * t / 24.0 },
    };
    int point = static_cast<int> (floor) - 2;
    for (int& index : r.index)
        index = axis.mirrored (point++);
    for (double& slope : r.slope)
        slope /= axis.spacing;
    return r;
}

/// Turns n + 1 values, `stride` apart, into weights: one causal and one anti-causal pass per pole (Unser 1999, box 2).
void filterBothWays (double* first, int stride, int n, double pole)
{
    if (n == 0) return;
    const auto c = [&] (int k) -> double& { return first[static_cast<std::ptrdiff_t> (k) * stride]; };

    double start = c (0) + math::pow (pole, n) * c (n), forth = pole, back = math::pow (pole, 2 * n - 1);
    for (int k = 1; k < n; ++k, forth *= pole, back /= pole)
        start += (forth + back) * c (k);
    c (0) = start / (1.0 - math::pow (pole, 2 * n));
    for (int k = 1; k <= n; ++k)
        c (k) += pole * c (k - 1);
    c (n) = pole / (pole * pole - 1.0) * (c (n) + pole * c (n - 1));
    for (int k = n - 1; k >= 0; --k)
        c (k) = pole * (c (k + 1) - c (k));
    for (int k = 0; k <= n; ++k)
        c (k) *= (1.0 - pole) * (1.0 - 1.0 / pole);
}
}   // namespace

SplineSurface::SplineSurface (MirroredGrid points) : weights (std::move (points))
{
    for (const double pole : { -0.430575347099973792, -0.0430962882032646536 })
    {
        for (int row = 0; row < weights.y.points(); ++row)
            filterBothWays (&weights (row, 0), 1, weights.x.intervals, pole);
        for (int column = 0; column < weights.x.points(); ++column)
            filterBothWays (&weights (0, column), weights.x.points(), weights.y.intervals, pole);
    }
}

SplineSurface::Point SplineSurface::operator() (double at_x, double at_y) const noexcept
{
    const Reach x = reach (weights.x, at_x), y = reach (weights.y, at_y);
    Point sum;
    for (std::size_t j = 0; j < 6; ++j)
    {
        const double* row = weights.values.data() + at (y.index[j]) * at (weights.x.points());
        double height = 0.0, slope = 0.0;
        for (std::size_t i = 0; i < 6; ++i)
        {
            height += x.weight[i] * row[x.index[i]];
            slope += x.slope[i] * row[x.index[i]];
        }
        sum.height += y.weight[j] * height;
        sum.slope_x += y.weight[j] * slope;
        sum.slope_y += y.slope[j] * height;
    }
    return sum;
}

/// The second derivatives of a B-spline are averages of the second differences of its weights, so these differences bound the
/// derivatives.
double SplineSurface::largestCurvature() const noexcept
{
    const auto weight = [this] (int column, int row) { return weights (weights.y.mirrored (row), weights.x.mirrored (column)); };
    double xx = 0.0, yy = 0.0, xy = 0.0;
    for (int j = 0; j < weights.y.points(); ++j)
        for (int i = 0; i < weights.x.points(); ++i)
        {
            xx = std::max (xx, std::abs (weight (i - 1, j) - 2.0 * weight (i, j) + weight (i + 1, j)));
            yy = std::max (yy, std::abs (weight (i, j - 1) - 2.0 * weight (i, j) + weight (i, j + 1)));
            xy = std::max (xy, std::abs (weight (i, j) - weight (i + 1, j) - weight (i, j + 1) + weight (i + 1, j + 1)));
        }
    const double dx = weights.x.spacing, dy = weights.y.spacing;
    return std::max (xx / (dx * dx), yy / (dy * dy)) + xy / (dx * dy);
}

}   // namespace tactus
