// SPDX-License-Identifier: MIT
#include "height_steps.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tactus
{

namespace
{
/// The common step of some values; 0 if they have none, or have too many different values to be rounded ones.
double commonStep (std::vector<double> values)
{
    constexpr std::size_t most_levels = 4096;
    constexpr double rounding = 1e-4;   // of a step
    std::ranges::sort (values);
    const double range = values.back() - values.front();
    std::vector<double> levels;
    for (const double v : values)
        if (levels.empty() || v - levels.back() > 1e-9 * range) levels.push_back (v);
    if (levels.size() < 3 || levels.size() > most_levels || 2 * levels.size() > values.size()) return 0.0;
    double step = range;
    for (std::size_t i = 1; i < levels.size(); ++i)
        step = std::min (step, levels[i] - levels[i - 1]);
    for (const double v : levels)
        if (const double steps = (v - levels.front()) / step; std::abs (steps - std::round (steps)) > rounding * std::max (1.0, steps)) return 0.0;
    return step;
}

/// One average over `width` points along lines of `count` numbers that are `stride` apart, mirrored at both ends.
void average (std::vector<double>& values, std::size_t begin, std::size_t stride, int count, int half)
{
    if (count < 2) return;
    const int period = 2 * (count - 1);
    const auto at = [&] (int i) {
        i = ((i % period) + period) % period;
        return values[begin + stride * static_cast<std::size_t> (i < count ? i : period - i)];
    };
    std::vector<double> sums { 0.0 };   // sums[i]: of the first i numbers from -half on
    for (int i = -half; i < count + half; ++i)
        sums.push_back (sums.back() + at (i));
    const int width = 2 * half + 1;
    for (int i = 0; i < count; ++i)
        values[begin + stride * static_cast<std::size_t> (i)] = (sums[static_cast<std::size_t> (i + width)] - sums[static_cast<std::size_t> (i)]) / width;
}
}   // namespace

double feltStep (const Grid& grid)
{
    if (grid.values.size() < 16) return 0.0;
    const double step = commonStep (grid.values);
    if (! (step > 0.0)) return 0.0;
    std::size_t level = 0, single = 0, all = 0;
    const auto count = [&] (double a, double b) {
        const double steps = std::abs (a - b) / step;
        ++all;
        if (steps < 0.5)
            ++level;
        else if (steps < 1.5)
            ++single;
    };
    for (int row = 0; row < grid.rows; ++row)
        for (int column = 0; column < grid.columns; ++column)
        {
            if (column + 1 < grid.columns) count (grid (row, column), grid (row, column + 1));
            if (row + 1 < grid.rows) count (grid (row, column), grid (row + 1, column));
        }
    const auto differing = static_cast<double> (all - level);
    const bool are_stairs = static_cast<double> (single) > 0.5 * differing && static_cast<double> (level) > 0.1 * static_cast<double> (all);
    return differing > 0.0 && are_stairs ? step : 0.0;
}

MirroredGrid smoothedOver (MirroredGrid grid, double length)
{
    const int columns = grid.x.intervals + 1, rows = grid.y.intervals + 1;
    const auto halfOf = [&] (double spacing, int count) { return static_cast<int> (std::clamp (std::round (0.5 * length / spacing), 0.0, count - 1.0)); };
    for (int pass = 0; pass < 3; ++pass)
    {
        for (int row = 0; row < rows; ++row)
            average (grid.values, static_cast<std::size_t> (row) * static_cast<std::size_t> (columns), 1, columns, halfOf (grid.x.spacing, columns));
        for (int column = 0; column < columns; ++column)
            average (grid.values, static_cast<std::size_t> (column), static_cast<std::size_t> (columns), rows, halfOf (grid.y.spacing, rows));
    }
    return grid;
}

}   // namespace tactus
