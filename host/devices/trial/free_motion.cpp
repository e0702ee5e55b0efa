// SPDX-License-Identifier: MIT
#include "free_motion.hpp"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace tactus::host
{

namespace
{
using Vec4 = Eigen::Vector4d;

constexpr double least_travel = 5e-3, most_travel = 5e-2, starts = 2e-4, ends = 2e-4;   // m: beyond, a stop may be near; what counts as motion
constexpr double misfit_of_travel = 0.01, misfit_anyway = 5e-5;                         // m
constexpr double most_spring = 0.3;                                                     // N/m, that the pushes leave open
constexpr std::size_t least_rows = 50;
constexpr double student = 5.841;   // the 99.5 % point for three degrees of freedom, of four pushes

/// The rows while the tool moves in the direction of the push. Empty, with the reason, if they are too few.
std::span<const TrialRow> movingPart (const FreePush& push, std::string& why)
{
    const std::span<const TrialRow> all (std::ranges::find_if (push.rows, &TrialRow::is_valid), push.rows.end());   // the first tick has no reading
    const auto end = std::ranges::find_if (all, &TrialRow::halts);
    if (std::any_of (all.begin(), end, [] (const TrialRow& row) { return ! row.is_valid; })) return why = "a reading could not be used", all.first (0);
    if (end == all.begin()) return why = "no reading came", all.first (0);
    const auto along = [&] (const TrialRow& row) { return push.direction.dot (row.position - all.front().position); };
    const auto farther = [&] (double than) { return std::find_if (all.begin(), end, [&] (const TrialRow& row) { return along (row) > than; }); };
    const auto first = farther (starts);
    const auto farthest = std::max_element (all.begin(), end, [&] (const auto& a, const auto& b) { return along (a) < along (b); });
    if (along (*farthest) < least_travel) return why = "it moved by less than 5 mm", all.first (0);
    const auto last = farther (std::min (most_travel, along (*farthest) - ends));
    if (last - first < static_cast<std::ptrdiff_t> (least_rows)) return why = "its motion was too short", all.first (0);
    return { first, last };
}

/// Mass, damping and friction by least squares. The equation is integrated twice, so that no position is differentiated:
/// m x + B I(x) + c t^2/2 + k I(I(x)) + a t + b = I(I(F)), where I is the integral since the first row, a and b are what the first place and speed add, and
/// k is the stiffness of a spring that there should not be. `forces`: all rows of the push.
std::optional<Vec4> fit (std::span<const TrialRow> rows, std::span<const TrialRow> forces, const Vec3& direction, double delay_s)
{
    const auto count = static_cast<Eigen::Index> (rows.size());
    Eigen::Matrix<double, Eigen::Dynamic, 6> terms (count, 6);
    Eigen::VectorXd explained (count);
    const auto timeOf = [] (const TrialRow& row) { return row.tick_s - row.age; };   // of the place
    const double begin = timeOf (rows.front());
    double area = 0.0, areas = 0.0, impulse = 0.0, twice = 0.0, at = begin, before = begin, last_x = 0.0;
    auto force = std::find_if (forces.begin(), forces.end(), [&] (const TrialRow& row) { return row.tick_s + delay_s > begin; });
    const auto acting = [&] { return force == forces.begin() ? 0.0 : direction.dot (std::prev (force)->acting); };
    const auto advance = [&] (double to) {
        const double dt = to - at, f = acting();
        twice += dt * (impulse + 0.5 * dt * f);
        impulse += dt * f;
        at = to;
    };
    for (Eigen::Index i = 0; i < count; ++i)
    {
        const auto& row = rows[static_cast<std::size_t> (i)];
        const double time = timeOf (row), t = time - begin, x = direction.dot (row.position - rows.front().position);
        for (; force != forces.end() && force->tick_s + delay_s <= time; ++force)
            advance (force->tick_s + delay_s);
        advance (time);
        const double last_area = std::exchange (area, area + 0.5 * (x + last_x) * (time - before));
        areas += 0.5 * (area + last_area) * (time - before);
        terms.row (i) << x, area, 0.5 * t * t, areas, t, 1.0;
        explained[i] = twice;
        last_x = x;
        before = time;
    }
    const Eigen::Vector<double, 6> with_spring = terms.colPivHouseholderQr().solve (explained);
    const double spring = with_spring[3];
    terms.col (3).setZero();
    const Eigen::Vector<double, 6> found = terms.colPivHouseholderQr().solve (explained);
    if (! found.allFinite() || found[0] <= 0.0) return std::nullopt;
    const double misfit = (terms * found - explained).cwiseAbs().maxCoeff() / found[0];
    if (misfit > misfit_anyway + misfit_of_travel * last_x) return std::nullopt;
    return Vec4 (found[0], found[1], found[2], spring);
}
}   // namespace

std::optional<ToolMechanics> mechanicsOf (std::span<const FreePush> pushes, double delay_s, std::string& why)
{
    if (pushes.size() != free_pushes) return why = "there were fewer than four pushes", std::nullopt;
    double oldest = 0.25 * delay_s;
    for (const auto& push : pushes)
        for (const auto& row : push.rows)
            oldest = std::max (oldest, 1.25 * row.age);
    std::array<Between, 4> ranges {};
    bool is_first = true;
    for (const double delay : { -oldest, 1.25 * delay_s })
    {
        std::array<Vec4, free_pushes> found {};
        Vec4 mean = Vec4::Zero(), squares = Vec4::Zero();
        for (std::size_t i = 0; i < pushes.size(); ++i)
        {
            const auto rows = movingPart (pushes[i], why);
            if (rows.empty()) return std::nullopt;
            const auto one = fit (rows, pushes[i].rows, pushes[i].direction, delay);
            if (! one) return why = "it did not move as a tool does that only has mass, damping and friction", std::nullopt;
            found[i] = *one;
            mean += found[i] / free_pushes;
        }
        for (const auto& one : found)
            squares += (one - mean).cwiseAbs2();
        const Vec4 half = student * (squares / (free_pushes * (free_pushes - 1))).cwiseSqrt();
        for (int i = 0; i < 4; ++i)
        {
            auto& range = ranges[static_cast<std::size_t> (i)];
            range.least = is_first ? mean[i] - half[i] : std::min (range.least, mean[i] - half[i]);
            range.most = is_first ? mean[i] + half[i] : std::max (range.most, mean[i] + half[i]);
        }
        is_first = false;
    }
    if (ranges[3].least > most_spring || ranges[3].most < -most_spring)
        return why = "something like a spring pulls it", std::nullopt;
    if (ranges[2].most < 0.0) return why = "its readings came at other times than they say, as on a busy computer", std::nullopt;   // no friction pushes
    return ToolMechanics { ranges[0], ranges[1], ranges[2] };
}

}   // namespace tactus::host
