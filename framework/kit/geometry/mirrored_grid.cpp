// SPDX-License-Identifier: MIT
#include "mirrored_grid.hpp"
#include <tactus/kit/signal/windowed_sinc.hpp>

#include <cmath>
#include <numbers>

namespace tactus
{

namespace
{
struct GridTap
{
    int point;
    double weight;
};

/// For each new point, the old points that it is a weighted sum of.
std::vector<std::vector<GridTap>> tapsOf (const MirroredAxis& from, const MirroredAxis& to, double cutoff, double zeros)
{
    const double reach = 0.5 * zeros / cutoff;
    const auto kernel = [&] (double distance) {
        const double r = distance / reach, phase = 2.0 * std::numbers::pi * cutoff * distance;
        return std::abs (r) >= 1.0 ? 0.0 : sinc (phase) * kaiser60 (r);
    };

    std::vector<std::vector<GridTap>> all (at (to.points()));
    for (std::size_t k = 0; k < all.size(); ++k)
    {
        const double place = static_cast<double> (k) * to.spacing;
        double sum = 0.0;
        all[k].reserve (at (static_cast<int> (2.0 * reach / from.spacing) + 2));
        for (int i = static_cast<int> (std::ceil ((place - reach) / from.spacing)); i * from.spacing <= place + reach; ++i)
        {
            all[k].push_back ({ from.mirrored (i), kernel (i * from.spacing - place) });
            sum += all[k].back().weight;
        }
        for (GridTap& tap : all[k])
            tap.weight /= sum;
    }
    return all;
}

MirroredGrid withRowsResampled (MirroredGrid from, const MirroredAxis& to, double cutoff, double zeros)
{
    if (from.x.intervals == 0) return from;
    const auto taps = tapsOf (from.x, to, cutoff, zeros);
    MirroredGrid result { to, from.y, std::vector<double> (at (to.points()) * at (from.y.points())) };
    for (int row = 0; row < from.y.points(); ++row)
        for (int k = 0; k < to.points(); ++k)
            for (const auto& [point, weight] : taps[at (k)])
                result (row, k) += weight * from (row, point);
    return result;
}

MirroredGrid transposed (const MirroredGrid& from)
{
    MirroredGrid to { from.y, from.x, std::vector<double> (from.values.size()) };
    for (int row = 0; row < from.y.points(); ++row)
        for (int column = 0; column < from.x.points(); ++column)
            to (column, row) = from (row, column);
    return to;
}
}   // namespace

double meanOf (const MirroredGrid& grid)
{
    const auto times = [] (const MirroredAxis& a, int i) { return i == 0 || i == a.intervals ? 1.0 : 2.0; };
    double sum = 0.0, all = 0.0;
    for (int row = 0; row < grid.y.points(); ++row)
        for (int column = 0; column < grid.x.points(); ++column)
        {
            const double weight = times (grid.x, column) * times (grid.y, row);
            sum += weight * grid (row, column);
            all += weight;
        }
    return sum / all;
}

MirroredGrid resampled (const MirroredGrid& grid, const MirroredAxis& to_x, const MirroredAxis& to_y, double cutoff, double zeros)
{
    const MirroredGrid rows = withRowsResampled (grid, to_x, cutoff, zeros);
    return transposed (withRowsResampled (transposed (rows), to_y, cutoff, zeros));
}

}   // namespace tactus
