// SPDX-License-Identifier: MIT
#include "free_motion.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <vector>

namespace tactus::host
{

std::optional<FreeMotion> freeMotionOf (std::span<const TrialRow> rows, int axis, double period_s)
{
    constexpr double least_travel = 5e-3, moves = 2e-4;   // m
    constexpr double most_misfit = 0.01;                  // of the largest value that is explained
    constexpr std::size_t least_rows = 50;
    const auto end = std::ranges::find_if (rows, [] (const TrialRow& row) { return row.halts || ! row.is_valid; });
    if (end == rows.begin() || (end != rows.end() && ! end->halts)) return std::nullopt;
    const auto placeIn = [axis] (const TrialRow& row) { return row.position[axis]; };
    const double rest = placeIn (rows.front());
    const auto first = std::find_if (rows.begin(), end, [&] (const TrialRow& row) { return placeIn (row) - rest > moves; });   // else friction holds it
    const auto count = std::distance (first, end);
    if (count < static_cast<std::ptrdiff_t> (least_rows) || placeIn (*std::prev (end)) - rest < least_travel) return std::nullopt;

    // m x'' + B x' + c = F, integrated twice, so that nothing is differentiated: m x + B I(x) + c t^2/2 - m v0 t = I(I(F)), where I is the integral.
    Eigen::MatrixX4d terms (count, 4);
    Eigen::VectorXd explained (count);
    double area = 0.0, impulse = 0.0, twice = 0.0, t = 0.0;
    for (auto row = first; row != end; ++row, t += period_s)
    {
        const double x = placeIn (*row) - placeIn (*first), force = row->acting[axis];
        terms.row (std::distance (first, row)) << x, area, 0.5 * t * t, t;
        explained[std::distance (first, row)] = twice;
        area += period_s * x;
        twice += period_s * (impulse + 0.5 * period_s * force);
        impulse += period_s * force;
    }
    const Eigen::Vector4d found = terms.colPivHouseholderQr().solve (explained);
    const double misfit = (terms * found - explained).cwiseAbs().maxCoeff();
    if (! found.allFinite() || found[0] <= 0.0 || misfit > most_misfit * explained.cwiseAbs().maxCoeff()) return std::nullopt;
    return FreeMotion { found[0], std::max (0.0, found[1]), std::max (0.0, found[2]) };
}

}   // namespace tactus::host
