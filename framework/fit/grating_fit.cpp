// SPDX-License-Identifier: MIT
#include "grating_fit.hpp"
#include "least_squares.hpp"

#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tactus
{

namespace
{
using detail::fitError;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t fewest_profile_rows = 40;
constexpr Index bow_terms = 3;   // height, tilt and bow of the sample

/// Heights relative to `unit`, over positions from 0.
struct Profile
{
    VectorXd x, height;
    double origin = 0.0, unit = 1.0;

    Index size() const { return x.size(); }
    double length() const { return x[x.size() - 1]; }
};

/// The parameters of the search: ln (ridges per metre), cosine and sine of each harmonic, then the bow.
class RidgeSearch
{
public:
    RidgeSearch (const Profile& p, Index h, const FitCourse* c, bool skips = false) : profile (p), harmonics (h), course (c)
    {
        const Index block = std::max<Index> (1, p.size() / 50);
        weight = VectorXd::Ones (p.size());
        for (Index i = 0; skips && i < p.size(); ++i)
            if (i / block % 5 == 2) weight[i] = 0.0;
    }

    Index parameters() const { return 1 + linear(); }
    Index linear() const { return 2 * harmonics + bow_terms; }
    bool isLeftOut (Index i) const { return weight[i] == 0.0; }
    VectorXd modelled (const VectorXd& x) const { return terms (math::exp (x[0])) * x.tail (linear()); }

    /// The parameters for this many ridges per metre, with harmonics and bow by linear least squares.
    VectorXd start (double per_metre) const
    {
        const MatrixXd all = weight.asDiagonal() * terms (per_metre);
        VectorXd x (parameters());
        x[0] = math::log (per_metre);
        x.tail (linear()) = (all.transpose() * all).ldlt().solve (all.transpose() * profile.height);
        return x;
    }

    detail::LeastSquares problem() const
    {
        return { .rows = profile.size(),
                 .residual = [this] (const VectorXd& x, VectorXd& r) { r = weight.cwiseProduct (profile.height - modelled (x)); },
                 .jacobian = [this] (const VectorXd& x, MatrixXd& j) { setSlopes (x, j); },
                 .size = std::sqrt (profile.height.squaredNorm() / static_cast<double> (profile.size())),
                 .course = course };
    }

private:
    MatrixXd terms (double per_metre) const
    {
        MatrixXd t (profile.size(), linear());
        for (Index i = 0; i < profile.size(); ++i)
        {
            for (Index h = 0; h < harmonics; ++h)
            {
                const auto [sine, cosine] = math::sinCos (2.0 * std::numbers::pi * per_metre * static_cast<double> (h + 1) * profile.x[i]);
                t (i, 2 * h) = cosine;
                t (i, 2 * h + 1) = sine;
            }
            const double u = 2.0 * profile.x[i] / profile.length() - 1.0;
            t (i, 2 * harmonics) = 1.0;
            t (i, 2 * harmonics + 1) = u;
            t (i, 2 * harmonics + 2) = 2.0 * u * u - 1.0;
        }
        return t;
    }

    void setSlopes (const VectorXd& x, MatrixXd& j) const
    {
        const double per_metre = math::exp (x[0]);
        const MatrixXd t = terms (per_metre);
        j.rightCols (linear()) = -(weight.asDiagonal() * t);
        for (Index i = 0; i < profile.size(); ++i)
        {
            double slope = 0.0;
            for (Index h = 0; h < harmonics; ++h)
                slope += static_cast<double> (h + 1) * (x[2 + 2 * h] * t (i, 2 * h) - x[1 + 2 * h] * t (i, 2 * h + 1));
            j (i, 0) = -weight[i] * 2.0 * std::numbers::pi * per_metre * profile.x[i] * slope;
        }
    }

    const Profile& profile;
    Index harmonics;
    const FitCourse* course;
    VectorXd weight;
};

Result<Profile> profileOf (const RecordedProfile& recorded)
{
    if (auto checked = detail::checkColumns ({ &recorded.position, &recorded.height }, fewest_profile_rows, "at least five ridges"); ! checked)
        return checked.error();
    if (std::ranges::adjacent_find (recorded.position, std::ranges::greater_equal {}) != recorded.position.end())
        return fitError ("fit/position", "the positions do not increase from row to row", "sort the rows by position, and scan in one direction");
    const auto n = static_cast<Index> (recorded.height.size());
    Profile p { .x = Eigen::Map<const VectorXd> (recorded.position.data(), n),
                .height = Eigen::Map<const VectorXd> (recorded.height.data(), n),
                .origin = recorded.position[0] };
    p.x.array() -= p.origin;
    p.unit = (p.height.array() - p.height.mean()).matrix().cwiseAbs().maxCoeff();
    if (! (p.unit > 0.0)) return fitError ("fit/flat", "all heights are the same", "check which column is read");
    p.height /= p.unit;
    return p;
}

/// The strongest spatial frequency that has at least two ridges, in 1/m. Rows are averaged to at most 2000.
double strongestRidge (const Profile& p, const FitCourse* course)
{
    const RidgeSearch bow (p, 0, nullptr);
    const VectorXd level = p.height - bow.modelled (bow.start (1.0));
    const Index block = (p.size() + 1999) / 2000, n = p.size() / block;
    VectorXd heights (n), places (n);
    for (Index i = 0; i < n; ++i)
    {
        heights[i] = level.segment (i * block, block).mean();
        places[i] = p.x.segment (i * block, block).mean();
    }
    const double step = 0.5 / p.length();
    double best = 0.0, strongest = 0.0;
    for (Index k = 4; k < n && ! detail::isCancelled (course); ++k)
    {
        const double per_metre = step * static_cast<double> (k);
        double cosines = 0.0, sines = 0.0;
        for (Index i = 0; i < n; ++i)
        {
            const auto [sine, cosine] = math::sinCos (2.0 * std::numbers::pi * per_metre * places[i]);
            cosines += heights[i] * cosine;
            sines += heights[i] * sine;
        }
        const double power = cosines * cosines + sines * sines;
        if (power <= strongest) continue;
        strongest = power;
        best = per_metre;
    }
    return best;
}

struct FoundRidges
{
    Index harmonics = 0;
    detail::LeastSquaresFit fit;
    double score = std::numeric_limits<double>::infinity();
};

/// The strongest line may be the first, second or third harmonic.
FoundRidges searchRidges (const Profile& p, Index most, FitCourse* course)
{
    const double strongest = strongestRidge (p, course);
    constexpr double doubt = 12.0;   // penalty for a strongest line that is not the first harmonic: without it, noise could double the period
    FoundRidges best;
    double independent = 0.0;
    for (Index number = 1; number <= 3; ++number)
    {
        const double per_metre = strongest / static_cast<double> (number);
        if (! (per_metre * p.length() > 1.5)) break;
        for (Index harmonics = number; harmonics <= most; ++harmonics)
        {
            detail::setShare (course, (static_cast<double> (number - 1) + static_cast<double> (harmonics) / static_cast<double> (most)) / 4.0);
            if (detail::isCancelled (course)) return best;
            if (! (per_metre * static_cast<double> (harmonics) * p.length() < 0.45 * static_cast<double> (p.size()))) break;
            const RidgeSearch search (p, harmonics, course);
            auto fit = detail::minimise (search.problem(), search.start (per_metre));
            if (independent == 0.0) independent = std::max (20.0, detail::independentRows (fit.residual));
            const double n = static_cast<double> (p.size());
            const double score = n * math::log (fit.sumToCompare()) + static_cast<double> (search.parameters()) * math::log (n) * n / std::min (n, independent)
                                 + doubt * static_cast<double> (number - 1);
            if (score < best.score && fit.x.allFinite()) best = { harmonics, std::move (fit), score };
        }
    }
    return best;
}

void reportRidges (const Profile& p, const FoundRidges& found, GratingFit& result)
{
    const auto& x = found.fit.x;
    const auto covariance = detail::covarianceOf (found.fit);
    const double freedom = detail::independentRows (found.fit.residual) - static_cast<double> (x.size());
    auto& report = result.report;
    result.period = math::exp (-x[0]);
    report.values.push_back (detail::withLogInterval ("period", "m", result.period, std::sqrt (covariance (0, 0)), freedom));
    double largest = 0.0;
    for (Index h = 0; h < found.harmonics; ++h)
        largest = std::max (largest, math::hypot (x[1 + 2 * h], x[2 + 2 * h]));
    for (Index h = 0; h < found.harmonics; ++h)
    {
        const double amplitude = math::hypot (x[1 + 2 * h], x[2 + 2 * h]), halves = detail::halfWidth95 (freedom);
        const Eigen::Vector2d along { x[1 + 2 * h] / amplitude, x[2 + 2 * h] / amplitude };
        const double deviation = std::sqrt (detail::varianceAlong (covariance, 1 + 2 * h, along));
        // The phase counts from the position 0 of the recording.
        const double number = static_cast<double> (h + 1), shift = 2.0 * std::numbers::pi * number * p.origin / result.period;
        result.harmonics.push_back (
            { static_cast<int> (h + 1), p.unit * amplitude, math::remainder (math::atan2 (x[1 + 2 * h], x[2 + 2 * h]) - shift, 2.0 * std::numbers::pi) });
        report.values.push_back ({ "amplitude " + std::to_string (h + 1), "m", p.unit * amplitude, p.unit * std::max (0.0, amplitude - halves * deviation),
                                   p.unit * (amplitude + halves * deviation), amplitude > 0.3 * largest });
    }
}
}   // namespace

Result<GratingFit> fitGrating (const RecordedProfile& recorded, FitCourse* course)
{
    auto read = profileOf (recorded);
    if (! read) return read.error();
    const auto& p = *read;
    const auto found = searchRidges (p, std::clamp (recorded.most_harmonics, 1, 32), course);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    if (found.harmonics == 0)
        return fitError ("fit/no_ridges", "the profile has no regular ridges", "record at least five ridges, with at least ten rows per ridge");

    GratingFit result;
    auto& report = result.report;
    reportRidges (p, found, result);
    const RidgeSearch search (p, found.harmonics, course), skipping (p, found.harmonics, course, true);
    const VectorXd modelled = search.modelled (found.fit.x), off = p.height - search.modelled (detail::minimise (skipping.problem(), found.fit.x).x);
    double sum = 0.0, count = 0.0;
    for (Index i = 0; i < off.size(); ++i)
        if (skipping.isLeftOut (i))
        {
            sum += off[i] * off[i];
            count += 1.0;
        }
    const RidgeSearch bow (p, 0, course);
    const VectorXd level = p.height - bow.modelled (bow.start (1.0));
    report.rows = recorded.height.size();
    report.residual_unit = "m";
    report.residual = p.unit * std::sqrt (found.fit.sum() / static_cast<double> (p.size()));
    report.left_out_residual = p.unit * std::sqrt (sum / count);
    report.size = p.unit * std::sqrt (level.squaredNorm() / static_cast<double> (p.size()));
    const VectorXd drawn = p.unit * modelled;
    report.picture = { "position",
                       "m",
                       "height",
                       "m",
                       { { "recorded", recorded.position, recorded.height, true }, { "fitted", recorded.position, { drawn.begin(), drawn.end() } } } };
    if (p.length() < 3.0 * result.period)
        report.lacking.push_back ("the recording contains only " + roundedText (p.length() / result.period, 2) + " ridges");
    judge (report, "Scan at least five ridges in a straight line across them, with at least ten rows per ridge.");
    return result;
}

}   // namespace tactus
