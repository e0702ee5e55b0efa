// SPDX-License-Identifier: MIT
#include "curve_fit.hpp"
#include "least_squares.hpp"

#include <tactus/kit/at.hpp>
#include <tactus/text/number_text.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>

namespace tactus
{

namespace
{
constexpr std::size_t fewest_branch_rows = 8;

/// The force at evenly spaced depths, from one spacing to the deepest, with straight lines between them and from (0, 0).
struct Fitted
{
    std::vector<double> force, weight;   // in N; the number of rows that each force is based on
};

constexpr double straight = 1e-6;   // weight of the second differences, in rows

/// Adds the squares of the second differences, f[i - 1] - 2 f[i] + f[i + 1] with 0 before the first.
void addStraightness (Eigen::MatrixXd& normal)
{
    for (Eigen::Index i = 0; i + 1 < normal.rows(); ++i)
    {
        const Eigen::Index indices[] { i - 1, i, i + 1 };
        const double factors[] { 1.0, -2.0, 1.0 };
        for (int a = i == 0 ? 1 : 0; a < 3; ++a)
            for (int b = i == 0 ? 1 : 0; b < 3; ++b)
                normal (indices[a], indices[b]) += straight * factors[a] * factors[b];
    }
}

/// Least squares. At a depth without a row nearby, the curve continues that of its neighbours in a straight line.
Fitted leastSquares (const std::vector<double>& d, const std::vector<double>& f, double spacing, int points)
{
    Eigen::MatrixXd normal = Eigen::MatrixXd::Zero (points, points);
    Eigen::VectorXd right = Eigen::VectorXd::Zero (points);
    Fitted fitted;
    fitted.weight.assign (at (points), straight);
    for (std::size_t i = 0; i < d.size(); ++i)
    {
        const double u = d[i] / spacing;
        const int upper = std::clamp (static_cast<int> (u), 0, points - 1);   // the point of the table above the row; the point below is upper - 1
        const double share = u - upper;
        right[upper] += share * f[i];
        normal (upper, upper) += share * share;
        fitted.weight[at (upper)] += share;
        if (upper == 0) continue;   // the point below is (0, 0)
        right[upper - 1] += (1.0 - share) * f[i];
        normal (upper - 1, upper - 1) += (1.0 - share) * (1.0 - share);
        normal (upper - 1, upper) += share * (1.0 - share);
        normal (upper, upper - 1) += share * (1.0 - share);
        fitted.weight[at (upper - 1)] += 1.0 - share;
    }
    addStraightness (normal);
    const Eigen::VectorXd solved = normal.ldlt().solve (right);
    fitted.force.assign (solved.begin(), solved.end());
    return fitted;
}

/// Replaces neighbouring forces that fall with depth by their mean, until none falls, and negative forces by 0.
void pool (Fitted& fitted)
{
    struct Block
    {
        double force, weight;
        std::size_t size;
    };
    std::vector<Block> blocks;
    for (std::size_t i = 0; i < fitted.force.size(); ++i)
    {
        blocks.push_back ({ fitted.force[i], fitted.weight[i], 1 });
        while (blocks.size() > 1 && blocks[blocks.size() - 2].force > blocks.back().force)
        {
            const Block last = blocks.back();
            blocks.pop_back();
            Block& before = blocks.back();
            before.force = (before.force * before.weight + last.force * last.weight) / (before.weight + last.weight);
            before.weight += last.weight;
            before.size += last.size;
        }
    }
    std::size_t i = 0;
    for (const auto& block : blocks)
        for (std::size_t k = 0; k < block.size; ++k, ++i)
            fitted.force[i] = std::max (0.0, block.force);
}

/// The noise of a row, from its distance to the straight line through its neighbours.
double noiseOf (const std::vector<double>& f)
{
    double squares = 0.0;
    for (std::size_t i = 2; i < f.size(); ++i)
        squares += (f[i] - 2.0 * f[i - 1] + f[i - 2]) * (f[i] - 2.0 * f[i - 1] + f[i - 2]);
    return std::sqrt (squares / (6.0 * static_cast<double> (std::max<std::size_t> (3, f.size()) - 2)));
}

/// The largest fall of the force as the depth grows, between means over a fortieth of the depth. Falls that may be noise do not count.
struct Fall
{
    double by = 0.0, from = 0.0;   // N
};

Fall largestFall (const std::vector<double>& d, const std::vector<double>& f, double deepest)
{
    constexpr double noisy = 5.0;   // deviations; a fall is the largest of several hundred differences
    const auto bins = std::clamp<std::size_t> (d.size() / 4, 1, 40);
    std::vector<double> sum (bins), rows (bins);
    for (std::size_t i = 0; i < d.size(); ++i)
    {
        const auto bin = std::min (bins - 1, static_cast<std::size_t> (d[i] / deepest * static_cast<double> (bins)));
        sum[bin] += f[i];
        rows[bin] += 1.0;
    }
    const double noise = noiseOf (f);
    Fall largest;
    double highest = -std::numeric_limits<double>::infinity(), rows_there = 1.0;
    for (std::size_t k = 0; k < bins; ++k)
    {
        if (rows[k] == 0.0) continue;
        const double mean = sum[k] / rows[k], by = highest - mean;
        if (by > largest.by && by > noisy * noise * std::sqrt (1.0 / rows[k] + 1.0 / rows_there)) largest = { by, highest };
        if (mean <= highest) continue;
        highest = mean;
        rows_there = rows[k];
    }
    return largest;
}

/// Straight lines through these forces.
Law tableOf (double spacing, std::vector<double> force)
{
    Law law { .kind = Law::Kind::table };
    for (std::size_t i = 0; i < force.size(); ++i)
        law.table.x.push_back (spacing * static_cast<double> (i + 1));
    law.table.y = std::move (force);
    return law;
}

double workAlong (const std::vector<double>& d, const std::vector<double>& f)
{
    double sum = 0.0;
    for (std::size_t i = 1; i < d.size(); ++i)
        sum += 0.5 * (f[i - 1] + f[i]) * (d[i] - d[i - 1]);
    return sum;
}

Result<> checkBranches (const RecordedLoop& loop)
{
    const auto n = loop.depth.size();
    if (n < fewest_branch_rows || loop.force.size() != n)
        return detail::fitError ("fit/too_short",
                                 "the recording has " + std::to_string (n) + " rows; a fit needs at least " + std::to_string (fewest_branch_rows),
                                 "record the whole indentation, from the touch to the deepest point and, for the hysteresis, back");
    for (const auto* column : { &loop.depth, &loop.force })
        if (! std::ranges::all_of (*column, [] (double v) { return std::isfinite (v); }))
            return detail::fitError ("fit/not_finite", "the recording contains nan or inf", "leave out the rows without a measurement");
    return {};
}

/// The rows inside the object around the deepest row: the way in up to this row, the way out after it.
Result<CurveFit> rowsOf (const RecordedLoop& loop)
{
    const auto& d = loop.depth;
    const auto deepest = static_cast<std::size_t> (std::ranges::max_element (d) - d.begin());
    auto first = deepest, last = deepest;
    while (first > 0 && d[first - 1] > 0.0)
        --first;
    while (last + 1 < d.size() && d[last + 1] > 0.0)
        ++last;
    if (! (d[deepest] > 0.0) || deepest - first + 1 < fewest_branch_rows)
        return detail::fitError (
            "fit/no_contact", "the way in has " + std::to_string (d[deepest] > 0.0 ? deepest - first + 1 : 0) + " rows with a depth above 0",
            "give the depth positive inside the object and 0 at the touch, with at least " + std::to_string (fewest_branch_rows) + " rows on the way in");
    const auto part = [] (const std::vector<double>& all, std::size_t from, std::size_t to) {
        return std::vector<double> (all.begin() + static_cast<std::ptrdiff_t> (from), all.begin() + static_cast<std::ptrdiff_t> (to) + 1);
    };
    CurveFit fit { .depth_in = part (d, first, deepest), .force_in = part (loop.force, first, deepest) };
    if (last - deepest >= fewest_branch_rows)
    {
        fit.depth_out = part (d, deepest + 1, last);
        fit.force_out = part (loop.force, deepest + 1, last);
    }
    return fit;
}

/// The change of the force at each depth of the table with each recorded force, before the curve is made monotone.
Eigen::MatrixXd influenceOnBranch (const std::vector<double>& d, double spacing, int points)
{
    const auto rows = static_cast<Eigen::Index> (d.size());
    Eigen::MatrixXd terms = Eigen::MatrixXd::Zero (rows, points);
    for (Eigen::Index i = 0; i < rows; ++i)
    {
        const double u = d[at (i)] / spacing;
        const int upper = std::clamp (static_cast<int> (u), 0, points - 1);
        terms (i, upper) = u - upper;
        if (upper > 0) terms (i, upper - 1) = 1.0 - (u - upper);
    }
    Eigen::MatrixXd normal = terms.transpose() * terms;
    addStraightness (normal);
    return normal.ldlt().solve (terms.transpose());
}

/// Cross-validation of a branch, of which every fifth of 50 blocks is predicted from the rest: the sum of squared errors, and their number.
std::pair<double, double> leftOutOfBranch (const std::vector<double>& d, const std::vector<double>& f, double spacing, int points)
{
    const auto block = std::max<std::size_t> (1, d.size() / 50);
    const auto is_left_out = [block] (std::size_t i) { return i / block % 5 == 2; };
    std::vector<double> kept_d, kept_f;
    for (std::size_t i = 0; i < d.size(); ++i)
        if (! is_left_out (i))
        {
            kept_d.push_back (d[i]);
            kept_f.push_back (f[i]);
        }
    auto fitted = leastSquares (kept_d, kept_f, spacing, points);
    pool (fitted);
    const auto law = tableOf (spacing, std::move (fitted.force));
    std::pair<double, double> sum { 0.0, 0.0 };
    for (std::size_t i = 0; i < d.size(); ++i)
        if (is_left_out (i))
        {
            sum.first += (f[i] - law (d[i])) * (f[i] - law (d[i]));
            sum.second += 1.0;
        }
    return sum;
}

/// The covariance of the forces at the depths of a coarse table.
struct BranchErrors
{
    Eigen::MatrixXd covariance;
    Eigen::VectorXd work;   // of each force
    double freedom = 0.0;

    double ofWork() const { return work.dot (covariance * work); }
};

/// The errors ignore that the branches are made monotone: this changes only forces that differ by less than their errors, or that the curve
/// cannot follow. At depths without a row nearby, they are infinite.
BranchErrors errorsOfBranch (const std::vector<double>& d, const std::vector<double>& f, double spacing, int points)
{
    const auto influence = influenceOnBranch (d, spacing, points);
    auto smooth = leastSquares (d, f, spacing, points);
    pool (smooth);
    const auto law = tableOf (spacing, std::move (smooth.force));
    constexpr double nearly_none = 1e-3;   // rows
    Eigen::VectorXd left (influence.cols()), work = Eigen::VectorXd::Constant (points, spacing);
    for (Eigen::Index i = 0; i < left.size(); ++i)
        left[i] = f[at (i)] - law (d[at (i)]);
    work[points - 1] *= 0.5;
    auto covariance = detail::covarianceOf (influence, left, points, detail::rootMeanSquare (f));
    for (int i = 0; i < points; ++i)
        if (smooth.weight[at (i)] < nearly_none)
        {
            covariance.row (i).setZero();
            covariance.col (i).setZero();
            covariance (i, i) = std::numeric_limits<double>::infinity();
        }
    return { covariance, work, detail::independentRows (left) - points };
}

/// Intervals of at most 20 points, with at least two rows for each. Stops between the branches if the fit is cancelled.
void reportValues (CurveFit& fit, int points, FitCourse* course)
{
    auto& values = fit.report.values;
    const auto rows = fit.depth_out.empty() ? fit.depth_in.size() : std::min (fit.depth_in.size(), fit.depth_out.size());
    const int few = std::min ({ points, 20, static_cast<int> (std::max<std::size_t> (1, rows / 8)) * 4 });
    const double spacing = fit.depth_in.back() / few;
    const auto sd = [] (double variance) { return std::sqrt (std::max (0.0, variance)); };
    const auto in = errorsOfBranch (fit.depth_in, fit.force_in, spacing, few);

    // The deepest row is the one whose error is largest, as a rule one to two deviations too deep.
    const double noise = noiseOf (fit.depth_in), of_work = sd (in.ofWork()), of_end = 1.5 * noise * fit.law (fit.depth_in.back());
    values.push_back (detail::withInterval ("work on the way in", "J", fit.work, std::hypot (of_work, of_end), in.freedom));
    if (of_end > of_work)
        fit.report.notes.push_back ("the depth has noise of " + roundedText (1e6 * noise, 2)
                                    + " um rms, so the deepest row is not known better; only the interval of the work includes it");
    Eigen::MatrixXd of_mean = in.covariance;
    detail::setShare (course, 0.5);
    if (detail::isCancelled (course)) return;
    if (! fit.depth_out.empty())
    {
        const auto out = errorsOfBranch (fit.depth_out, fit.force_out, spacing, few);
        of_mean = 0.25 * (in.covariance + out.covariance);
        values.push_back (detail::withInterval ("hysteresis", "J", fit.area, sd (in.ofWork() + out.ofWork()), in.freedom, false));
    }
    for (int i = few / 4 - 1; i < few; i += std::max (1, few / 4))
        if (i >= 0)
        {
            const double depth = spacing * (i + 1);
            auto value =
                detail::withInterval ("force at " + roundedText (1e3 * depth, 3) + " mm", "N", fit.law (depth), sd (of_mean (i, i)), in.freedom, i == few - 1);
            value.low = std::min (value.low, value.value);
            values.push_back (value);
        }
}

void reportResiduals (CurveFit& fit, int points)
{
    auto& report = fit.report;
    const double spacing = fit.depth_in.back() / points;
    auto [sum, count] = leftOutOfBranch (fit.depth_in, fit.force_in, spacing, points);
    if (! fit.depth_out.empty())
    {
        const auto [out_sum, out_count] = leftOutOfBranch (fit.depth_out, fit.force_out, spacing, points);
        sum += out_sum;
        count += out_count;
    }
    double squares = 0.0;
    for (const auto* column : { &fit.force_in, &fit.force_out })
        for (const double f : *column)
            squares += f * f;
    report.rows = fit.depth_in.size() + fit.depth_out.size();
    report.residual_unit = "N";
    report.residual = fit.residual;
    report.left_out_residual = count > 0.0 ? std::sqrt (sum / count) : fit.residual;
    report.size = std::sqrt (squares / static_cast<double> (report.rows));
}

FitPicture pictureOf (const CurveFit& fit)
{
    auto x = fit.law.table.x, y = fit.law.table.y;
    x.insert (x.begin(), 0.0);
    y.insert (y.begin(), 0.0);
    FitPicture picture { "depth", "m", "force", "N", { { "recorded, on the way in", fit.depth_in, fit.force_in, true } } };
    if (! fit.depth_out.empty()) picture.curves.push_back ({ "recorded, on the way out", fit.depth_out, fit.force_out, true });
    picture.curves.push_back ({ "curve", x, y });
    return picture;
}
}   // namespace

Result<CurveFit> fitCurve (const RecordedLoop& loop, int points, FitCourse* course)
{
    if (auto checked = checkBranches (loop); ! checked) return checked.error();
    auto rows = rowsOf (loop);
    if (! rows) return rows.error();
    auto& fit = *rows;

    const double spacing = fit.depth_in.back() / points;
    double sum = 0.0;
    const auto branch = [&] (const std::vector<double>& d, const std::vector<double>& f) {
        auto fitted = leastSquares (d, f, spacing, points);
        pool (fitted);
        if (const auto fall = largestFall (d, f, fit.depth_in.back()); fall.by > fit.drop)
        {
            fit.drop = fall.by;
            fit.falls_from = fall.from;
        }
        auto law = tableOf (spacing, std::move (fitted.force));
        for (std::size_t i = 0; i < d.size(); ++i)
            sum += (f[i] - law (d[i])) * (f[i] - law (d[i]));
        return law;
    };
    if (detail::isCancelled (course)) return detail::fitCancelled();
    fit.law = branch (fit.depth_in, fit.force_in);
    fit.in = fit.law.table.y;
    fit.work = workAlong (fit.depth_in, fit.force_in);
    if (! fit.depth_out.empty())
    {
        fit.out = branch (fit.depth_out, fit.force_out).table.y;
        const double turn = 0.5 * (fit.force_in.back() + fit.force_out.front()) * (fit.depth_out.front() - fit.depth_in.back());
        fit.area = fit.work + turn + workAlong (fit.depth_out, fit.force_out);
        for (std::size_t i = 0; i < fit.in.size(); ++i)
            fit.law.table.y[i] = 0.5 * (fit.in[i] + fit.out[i]);
    }
    if (! (fit.law.table.y.back() > 0.0))
        return detail::fitError ("fit/pulls", "the recorded force is not above 0 inside the object",
                                 "give the force positive where it pushes the tool out of the object");
    fit.residual = std::sqrt (sum / static_cast<double> (fit.depth_in.size() + fit.depth_out.size()));
    fit.peak = std::max (*std::ranges::max_element (fit.force_in), fit.force_out.empty() ? 0.0 : *std::ranges::max_element (fit.force_out));
    detail::setShare (course, 0.25);
    if (! detail::isCancelled (course)) reportValues (fit, points, course);
    detail::setShare (course, 0.75);
    if (! detail::isCancelled (course)) reportResiduals (fit, points);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    fit.report.picture = pictureOf (fit);
    if (fit.clicks())
        fit.report.lacking.push_back ("the curve flattens a fall of the recorded force by " + roundedText (fit.drop, 3) + " N, from "
                                      + roundedText (fit.falls_from, 3) + " N, as in a key that clicks or a sample that bursts");
    judge (fit.report,
           fit.clicks() ? "For a key, record the way in and the way out, and use tactus fit switch: its graph keeps the click. For a sample that bursts, use "
                          "tactus fit blade."
                        : "Press slowly and along the normal, from the touch to the deepest point and back, and record at least 20 rows per point of the "
                          "curve.");
    return rows;
}

}   // namespace tactus
