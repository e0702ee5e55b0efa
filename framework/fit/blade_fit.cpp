// SPDX-License-Identifier: MIT
#include "blade_fit.hpp"
#include "least_squares.hpp"

#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tactus
{

namespace
{
using detail::fitError;
using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t fewest_cut_rows = 20;
constexpr double endless = std::numeric_limits<double>::infinity();

/// The rows, and the last row before the burst. If the sample does not burst, all rows are before the burst.
struct Cut
{
    std::vector<double> depth, force;
    Index last_whole = 0;
    bool bursts = false;
    double unit = 1.0;     // N: the largest force
    double length = 1.0;   // m: the depth at the burst, or the largest depth

    Index size() const { return static_cast<Index> (depth.size()); }
};

/// The parameters of the search: ln force at the depth `length`, [ln power of the law], and, after a burst: depth of the burst over length, ln force
/// while cutting, ln stiffness of the cracked sample over that of the whole one. Forces are divided by `unit`.
class CutSearch
{
public:
    CutSearch (const Cut& c, bool bends, const FitCourse* watch, bool skips = false) : cut (c), is_bent (bends), course (watch)
    {
        const Index block = std::max<Index> (1, c.size() / 50);
        weight = VectorXd::Ones (c.size());
        for (Index i = 0; skips && i < c.size(); ++i)
            if (i / block % 5 == 2) weight[i] = 0.0;
    }

    Index first() const { return is_bent ? 2 : 1; }
    Index parameters() const { return first() + (cut.bursts ? 3 : 0); }
    bool isLeftOut (Index i) const { return weight[i] == 0.0; }
    double power (const VectorXd& x) const { return is_bent ? math::exp (std::clamp (x[1], -1.2, 1.8)) : 1.0; }   // 0.3 to 6
    double atLength (const VectorXd& x) const { return cut.unit * math::exp (x[0]); }
    double rupture (const VectorXd& x) const { return cut.length * x[first()]; }
    double cutting (const VectorXd& x) const { return cut.unit * math::exp (x[first() + 1]); }
    double softening (const VectorXd& x) const { return math::exp (x[first() + 2]); }

    double whole (const VectorXd& x, double depth) const { return depth > 0.0 ? atLength (x) * math::pow (depth / cut.length, power (x)) : 0.0; }

    VectorXd start (double stiffness_force, double plateau) const
    {
        VectorXd x = VectorXd::Zero (parameters());
        x[0] = math::log (stiffness_force / cut.unit);
        if (! cut.bursts) return x;
        x[first()] = 1.0;
        x[first() + 1] = math::log (plateau / cut.unit);
        return x;
    }

    VectorXd modelled (const VectorXd& x) const
    {
        VectorXd force (cut.size());
        const double n = power (x);
        double crack = 0.0, stretch = endless, soft = 1.0;
        if (cut.bursts)
        {
            soft = softening (x);
            stretch = cut.length * math::pow (cutting (x) / (soft * atLength (x)), 1.0 / n);
            crack = burst (x, stretch);
        }
        for (Index i = 0; i < cut.size(); ++i)
        {
            const double depth = cut.depth[static_cast<std::size_t> (i)];
            if (i <= cut.last_whole)
                force[i] = whole (x, depth);
            else
            {
                crack = std::max (crack, depth - stretch);
                force[i] = soft * whole (x, depth - crack);
            }
        }
        return force;
    }

    detail::LeastSquares problem() const
    {
        return { .rows = cut.size(),
                 .residual = [this] (const VectorXd& x, VectorXd& r) {
                     r = weight.cwiseProduct ((Eigen::Map<const VectorXd> (cut.force.data(), cut.size()) - modelled (x)) / cut.unit);
                 },
                 .size = detail::rootMeanSquare (cut.force) / cut.unit,
                 .course = course };
    }

    /// True if the crack grows again after the burst, in so many rows that noise does not explain it.
    bool cutsOn (const VectorXd& x) const
    {
        const double stretch = cut.length * math::pow (cutting (x) / (softening (x) * atLength (x)), 1.0 / power (x)), crack = burst (x, stretch);
        const auto after = cut.depth.begin() + cut.last_whole + 1;
        const auto growing = std::count_if (after, cut.depth.end(), [&] (double depth) { return depth - stretch > crack; });
        return growing >= std::max<std::ptrdiff_t> (5, (cut.depth.end() - after) / 20);
    }

private:
    /// Length of the crack right after the burst: the largest root of G0 (d) = G1 (d - c) + R c, at most d. h (c) is concave.
    double burst (const VectorXd& x, double stretch) const
    {
        const double d = rupture (x), n = power (x), cost = cutting (x), soft = softening (x);
        const auto energy = [&] (double e) { return e > 0.0 ? whole (x, e) * e / (n + 1.0) : 0.0; };
        const auto left = [&] (double c) { return energy (d) - soft * energy (d - c) - cost * c; };
        const double top = std::max (0.0, d - stretch);
        if (! (left (top) > 0.0)) return top;
        double c = std::max (0.0, d);
        for (int i = 0; i < 60; ++i)
        {
            const double slope = cost - soft * whole (x, d - c), next = std::max (top, c + left (c) / slope);
            if (! (left (c) < 0.0) || ! (slope > 0.0) || ! (next < c)) break;
            c = next;
        }
        return c;
    }

    const Cut& cut;
    bool is_bent;
    const FitCourse* course;
    VectorXd weight;
};

double meanOf (const std::vector<double>& v, Index from, Index to)
{
    double sum = 0.0;
    for (Index i = from; i < to; ++i)
        sum += v[static_cast<std::size_t> (i)];
    return sum / static_cast<double> (to - from);
}

/// The largest drop of the force while the blade goes in, inside the sample. It must be clearly larger than the noise.
void findBurst (Cut& cut)
{
    const Index n = cut.size(), window = std::clamp<Index> (n / 60, 2, 12);
    double noise = 0.0;
    for (Index i = 2; i < n; ++i)
    {
        const auto k = static_cast<std::size_t> (i);
        const double bend = cut.force[k] - 2.0 * cut.force[k - 1] + cut.force[k - 2];
        noise += bend * bend;
    }
    noise = std::sqrt (noise / (6.0 * static_cast<double> (n - 2)));
    double largest = 0.0;
    for (Index i = window; i + window <= n; ++i)
    {
        const auto k = static_cast<std::size_t> (i);
        if (! (cut.depth[k] > cut.depth[k - 1] && cut.depth[k - 1] > 0.0)) continue;
        const double fall = meanOf (cut.force, i - window, i) - meanOf (cut.force, i, i + window),
                     before = cut.depth[k - 1] - cut.depth[static_cast<std::size_t> (i - window)];
        if (fall <= largest || before < 0.0) continue;
        largest = fall;
        cut.last_whole = i - 1;
    }
    const double most = *std::ranges::max_element (cut.force);
    cut.bursts = largest > 0.08 * most && largest > 4.0 * noise * std::sqrt (2.0 / static_cast<double> (window));
    if (! cut.bursts) cut.last_whole = n - 1;
}

Result<Cut> cutOf (const RecordedCut& recorded)
{
    if (auto checked =
            detail::checkColumns ({ &recorded.depth, &recorded.force }, fewest_cut_rows, "from the touch until the blade has cut several millimetres");
        ! checked)
        return checked.error();
    const auto first = std::ranges::find_if (recorded.depth, [] (double d) { return d > 0.0; });
    const auto skipped = first - recorded.depth.begin();
    if (recorded.depth.end() - first < static_cast<std::ptrdiff_t> (fewest_cut_rows))
        return fitError ("fit/no_contact", "fewer than " + std::to_string (fewest_cut_rows) + " rows have a depth above 0",
                         "give the depth in m, positive inside the sample and 0 at the touch");
    Cut cut { .depth = { first, recorded.depth.end() }, .force = { recorded.force.begin() + skipped, recorded.force.end() } };
    cut.unit = *std::ranges::max_element (cut.force);
    if (! (cut.unit > 0.0))
        return fitError ("fit/pulls", "the recorded force is never above 0", "give the force positive where it pushes the blade out of the sample");
    findBurst (cut);
    cut.length = cut.bursts ? cut.depth[static_cast<std::size_t> (cut.last_whole)] : *std::ranges::max_element (cut.depth);
    return cut;
}

struct FoundCut
{
    bool is_bent = false;
    Cut cut {};
    detail::LeastSquaresFit fit {};
    double score = endless;
};

/// Tries linear and power laws, each with the burst at the steepest drop of the force or at a neighbouring row.
FoundCut searchCut (const Cut& around, FitCourse* course)
{
    FoundCut best;
    const double n = static_cast<double> (around.size());
    double independent = n;   // rows
    const auto scoreOf = [&] (const detail::LeastSquaresFit& fit) {
        return n * math::log (fit.sumToCompare()) + static_cast<double> (fit.x.size()) * math::log (n) * n / independent;
    };
    double forces = 0.0, weights = 0.0;   // of the whole sample, around a line from the touch
    for (Index i = 0; i <= around.last_whole; ++i)
    {
        const double u = around.depth[static_cast<std::size_t> (i)] / around.length;
        forces += u * around.force[static_cast<std::size_t> (i)];
        weights += u * u;
    }
    const double stiff = forces / weights;
    auto tail = std::vector (around.force.begin() + around.last_whole, around.force.end());
    std::ranges::sort (tail);
    const double plateau = std::max (0.05 * around.unit, tail[tail.size() * 7 / 10]);
    const auto start = [&] (const Cut& cut, bool is_bent) {
        const CutSearch search (cut, is_bent, course);
        auto fit = detail::minimise (search.problem(), search.start (std::max (1e-3 * cut.unit, stiff), plateau));
        const double score = scoreOf (fit);
        if (fit.x.allFinite() && score < best.score) best = { is_bent, cut, std::move (fit), score };
    };
    constexpr Index most = 2;
    for (Index aside = around.bursts ? -most : 0; aside <= (around.bursts ? most : 0) && ! detail::isCancelled (course); ++aside)
    {
        Cut cut = around;
        cut.last_whole += aside;
        if (cut.bursts && (cut.last_whole < 4 || cut.last_whole + 4 > cut.size() || ! (cut.depth[static_cast<std::size_t> (cut.last_whole)] > 0.0))) continue;
        detail::setShare (course, 0.15 * static_cast<double> (aside + most));
        start (cut, false);
    }
    if (! std::isfinite (best.score) || detail::isCancelled (course)) return best;
    independent = std::clamp (detail::independentRows (best.fit.residual), std::min (20.0, n), n);
    best.score = scoreOf (best.fit);
    start (Cut { best.cut }, true);
    return best;
}

/// The part of the report that needs a burst.
void reportBurst (const CutSearch& search, const FoundCut& found, const Eigen::MatrixXd& covariance, double freedom, BladeFit& result)
{
    const auto& x = found.fit.x;
    const auto& cut = found.cut;
    const Index b = search.first();
    auto& values = result.report.values;
    const auto row = static_cast<std::size_t> (cut.last_whole);

    // Force at the burst: F (d), with d from the fit but between the two rows.
    const double above = std::max (cut.depth[row], cut.depth[row + 1]), below = cut.depth[row];
    const double d = std::clamp (search.rupture (x), below, above), n = search.power (x), f = search.whole (x, d);
    const double half = detail::halfWidth95 (freedom), of_depth = half * cut.length * std::sqrt (covariance (b, b));
    double low = std::max (below, search.rupture (x) - of_depth), high = std::min (above, search.rupture (x) + of_depth);
    if (! (low < high)) std::tie (low, high) = std::pair { below, above };
    const double bend = n * math::log (d / cut.length);
    const double of_law = half * std::sqrt (found.is_bent ? detail::varianceAlong (covariance, 0, Eigen::Vector2d { 1.0, bend }) : covariance (0, 0));
    const double down = math::hypot (of_law, n * (d - low) / d), up = math::hypot (of_law, n * (high - d) / d);
    result.rupture_force = f;
    values.push_back ({ "rupture_force", "N", f, f * math::exp (-down), f * math::exp (up), true });

    result.toughness = search.cutting (x) / result.width;
    auto toughness = detail::withLogInterval ("toughness", "J/m2", result.toughness, std::sqrt (covariance (b + 1, b + 1)), freedom);
    if (! search.cutsOn (x))
    {
        toughness.high = endless;   // only a lower bound: the force would have risen further
        result.report.lacking.push_back ("the recording ends before the blade cuts on after the burst, so the toughness is uncertain");
    }
    values.push_back (toughness);
    const double softening = search.softening (x), of_softening = std::sqrt (covariance (b + 2, b + 2));
    values.push_back (detail::withLogInterval ("cracked stiffness ratio", "", softening, of_softening, freedom, false));
    if (softening < 1.0 && std::abs (x[b + 2]) > half * of_softening)
        result.cracked_law = { .kind = Law::Kind::power, .a = softening * result.law.a, .b = result.law.b };
    if (result.rupture_force < search.cutting (x))
    {
        result.report.notes.push_back (
            "the fitted force at the burst is below the cutting force, which the node cannot render; the preset bursts at the cutting force");
        result.rupture_force = search.cutting (x);
    }
}

void reportCut (const FoundCut& found, BladeFit& result)
{
    const CutSearch search (found.cut, found.is_bent, nullptr);
    const auto& x = found.fit.x;
    const auto& cut = found.cut;
    const auto covariance = detail::covarianceOf (found.fit);
    const double freedom = detail::independentRows (found.fit.residual) - static_cast<double> (search.parameters()), n = search.power (x);
    result.law = { .kind = Law::Kind::power, .a = search.atLength (x) / math::pow (cut.length, n), .b = n };
    auto& values = result.report.values;
    values.push_back (detail::withLogInterval ("stiffness", "N/m", search.atLength (x) / cut.length, std::sqrt (covariance (0, 0)), freedom));
    if (found.is_bent) values.push_back (detail::withLogInterval ("power of the law", "", n, std::sqrt (covariance (1, 1)), freedom, false));
    result.bursts = cut.bursts;
    if (cut.bursts) return reportBurst (search, found, covariance, freedom, result);

    result.rupture_force = 1.2 * cut.unit;
    result.toughness = 0.7 * result.rupture_force / result.width;
    values.push_back ({ "rupture_force", "N", result.rupture_force, cut.unit, endless, true });
    values.push_back ({ "toughness", "J/m2", result.toughness, 0.0, endless, true });
    result.report.lacking.push_back ("the sample did not burst, so the force at the burst and the toughness are guesses");
}
}   // namespace

Result<BladeFit> fitBlade (const RecordedCut& recorded, FitCourse* course)
{
    auto read = cutOf (recorded);
    if (! read) return read.error();
    const auto found = searchCut (*read, course);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    if (! std::isfinite (found.score) || ! (CutSearch (found.cut, found.is_bent, course).atLength (found.fit.x) > 0.0))
        return fitError ("fit/no_cut", "the force does not change with the depth as in a cut", "check the columns: depth in m, force in N");
    const auto& cut = found.cut;

    BladeFit result { .width = recorded.width };
    auto& report = result.report;
    reportCut (found, result);
    const CutSearch search (cut, found.is_bent, course), skipping (cut, found.is_bent, course, true);
    const VectorXd modelled = search.modelled (found.fit.x), others = search.modelled (detail::minimise (skipping.problem(), found.fit.x).x);
    double sum = 0.0, count = 0.0;
    for (Index i = 0; i < cut.size(); ++i)
        if (skipping.isLeftOut (i))
        {
            const double off = cut.force[static_cast<std::size_t> (i)] - others[i];
            sum += off * off;
            count += 1.0;
        }
    if (detail::isCancelled (course)) return detail::fitCancelled();
    report.rows = cut.depth.size();
    report.residual_unit = "N";
    report.residual = cut.unit * std::sqrt (found.fit.sum() / static_cast<double> (cut.size()));
    report.left_out_residual = count > 0.0 ? std::sqrt (sum / count) : report.residual;
    report.size = detail::rootMeanSquare (cut.force);
    report.picture = {
        "depth", "m", "force", "N", { { "recorded", cut.depth, cut.force, true }, { "fitted", cut.depth, { modelled.begin(), modelled.end() } } }
    };
    judge (report, "Press the blade in slowly, at a constant speed. Then cut at a steady force for as long as it took until the sample burst.");
    return result;
}

}   // namespace tactus
