// SPDX-License-Identifier: MIT
#include "friction_fit.hpp"
#include "least_squares.hpp"
#include "smooth_column.hpp"

#include <tactus/kit/math/math.hpp>
#include <tactus/kit/random.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace tactus
{

namespace
{
using detail::fitError;
using Eigen::Index;
using Eigen::VectorXd;

constexpr std::size_t fewest_drag_rows = 50;

/// The parameters that the search varies, besides mu and the offset. The force is linear in these two.
struct DragShape
{
    BristleAdhesion adhesion {};
    double d_max = 0.0, break_away = 1.0, first_stretch = 0.0;
};

/// The rows as the search needs them. The force is that on the tool.
struct Drag
{
    std::vector<double> position, force, load;   // load relative to the reference load
    double reference_load = 1.0, range = 0.0;    // N, m
    bool goes_both_ways = false;

    std::size_t size() const noexcept { return position.size(); }
};

/// The force on the tool per mu and per N of reference load.
VectorXd dragAlong (const Drag& drag, const DragShape& shape, std::size_t rows)
{
    Bristle bristle { .adhesion = shape.adhesion };
    const auto setBound = [&] (double load) {
        const double bound = std::max (1e-30, shape.d_max * load);
        const bool shrinks = bound < bristle.d_max;
        bristle.d_max = bristle.d_stick = bound;
        bristle.d_ba = shape.break_away * bound;
        return shrinks;
    };
    setBound (drag.load[0]);
    Vec3 d = Vec3::UnitX() * (shape.first_stretch * bristle.d_max);
    VectorXd force (static_cast<Index> (rows));
    for (std::size_t i = 0; i < rows; ++i)
    {
        if (i > 0)
        {
            if (setBound (drag.load[i])) bristle.letGo (d);
            d = bristle.stretch (d, Vec3::UnitX() * (drag.position[i] - drag.position[i - 1])).d;
        }
        force[static_cast<Index> (i)] = -d.x() / shape.d_max;
    }
    return force;
}

/// The parameters of the search: ln mu, ln d_max, the first stretch and then, if they are fitted, offset and the logit of break_away.
class DragSearch
{
public:
    DragSearch (const Drag& d, BristleAdhesion a, std::size_t r, const FitCourse* c) : drag (d), adhesion (a), rows (r), course (c) {}

    Index parameters() const { return 3 + offsets() + yields(); }
    Index offsets() const { return drag.goes_both_ways ? 1 : 0; }
    Index yields() const { return adhesion == BristleAdhesion::dupont ? 1 : 0; }

    double mu (const VectorXd& x) const { return math::exp (x[0]); }
    double offset (const VectorXd& x) const { return offsets() > 0 ? x[3] * unit() : 0.0; }
    static double share (double x) { return 1.0 / (1.0 + math::exp (-x)); }
    DragShape shape (const VectorXd& x) const
    {
        return { adhesion, math::exp (x[1]), yields() > 0 ? share (x[parameters() - 1]) : 1.0, std::clamp (x[2], -1.0, 1.0) };
    }
    VectorXd start (const DragShape& s, double mu, double zero) const
    {
        VectorXd x (parameters());
        x[0] = math::log (mu);
        x[1] = math::log (s.d_max);
        x[2] = s.first_stretch;
        if (offsets() > 0) x[3] = zero / unit();
        if (yields() > 0) x[parameters() - 1] = math::log (s.break_away / (1.0 - s.break_away));
        return x;
    }
    VectorXd modelled (const VectorXd& x, std::size_t up_to) const
    {
        return ((mu (x) * drag.reference_load) * dragAlong (drag, shape (x), up_to)).array() + offset (x);
    }
    detail::LeastSquares problem() const
    {
        return { .rows = static_cast<Index> (rows),
                 .residual = [this] (const VectorXd& x, VectorXd& r) {
                     r = Eigen::Map<const VectorXd> (drag.force.data(), static_cast<Index> (rows)) - modelled (x, rows);
                 },
                 .step = 1e-4,
                 .size = detail::rootMeanSquare (drag.force),
                 .course = course };
    }

private:
    double unit() const { return drag.reference_load; }

    const Drag& drag;
    BristleAdhesion adhesion;
    std::size_t rows;
    const FitCourse* course;
};

Result<Drag> dragOf (const RecordedDrag& recorded, std::vector<std::string>& notes)
{
    std::vector<const std::vector<double>*> columns { &recorded.position, &recorded.force };
    if (! recorded.load.empty()) columns.push_back (&recorded.load);
    if (auto checked = detail::checkColumns (columns, fewest_drag_rows, "several strokes back and forth"); ! checked) return checked.error();

    Drag drag { .position = recorded.position, .force = recorded.force, .load = recorded.load, .reference_load = recorded.assumed_load };
    const auto [low, high] = std::ranges::minmax_element (drag.position);
    drag.range = *high - *low;
    if (! (drag.range > 0.0)) return fitError ("fit/no_motion", "the position does not change", "record the position along the stroke, in m");
    if (drag.load.empty())
    {
        drag.load.assign (drag.size(), 1.0);
        notes.push_back ("the load was not recorded: mu is the force while sliding, divided by " + roundedText (recorded.assumed_load) + " N");
    }
    else
    {
        drag.reference_load = std::accumulate (drag.load.begin(), drag.load.end(), 0.0) / static_cast<double> (drag.size());
        if (! (drag.reference_load > 0.0))
            return fitError ("fit/no_load", "the mean normal force is not above 0",
                             "give the normal force in N, positive where the tool is pressed onto the surface");
        for (double& load : drag.load)
            load = std::max (0.0, load / drag.reference_load);
    }

    double forward = 0.0, back = 0.0, work = 0.0, middle = std::accumulate (drag.force.begin(), drag.force.end(), 0.0) / static_cast<double> (drag.size());
    for (std::size_t i = 1; i < drag.size(); ++i)
    {
        const double dx = drag.position[i] - drag.position[i - 1];
        (dx > 0.0 ? forward : back) += std::abs (dx);
        work += 0.5 * (drag.force[i] + drag.force[i - 1]) * dx;
    }
    drag.goes_both_ways = std::min (forward, back) > 0.2 * std::max (forward, back);
    if (drag.goes_both_ways) work -= middle * (drag.position.back() - drag.position.front());
    if (work > 0.0)
    {
        for (double& f : drag.force)
            f = -f;
        notes.push_back ("the recorded force points along the movement, so it is taken as the force of the hand; friction is the opposite force");
    }
    return drag;
}

/// The noise of a column of Drag, in the unit of the column.
struct ColumnNoise
{
    double deviation = 0.0;
    double weight = 0.0;   // of the smoothing; 0: the column is as recorded
};

/// The noise of the rows. A contact gives way at once where the load falls, and stretches only with the movement where it rises. So noise of the load
/// makes the modelled force too small, and mu too large. Noise of the position is movement back and forth, which lets a sliding contact relax.
struct DragNoise
{
    ColumnNoise load {}, position {};
};

/// The standard deviation of the rows around a curve, from the median, so that the corners that the curve cuts do not count.
double commonDeviation (const VectorXd& off, double rows)
{
    constexpr double deviations_per_median = 1.4826;   // of normal noise
    std::vector<double> sizes;
    for (const double v : off)
        sizes.push_back (std::abs (v));
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t> (sizes.size() / 2);
    std::ranges::nth_element (sizes, middle);
    return deviations_per_median * *middle / std::sqrt (std::max (1e-3, 1.0 - 1.0 / rows));
}

/// Whether a curve cuts corners of a column: the mean over half of the rows that it smooths over is somewhere farther off than noise explains.
bool cutsCorners (const VectorXd& off, double rows, double deviation)
{
    constexpr double most = 5.5;   // smooth strokes with noise reach 4.7, turns at a constant speed exceed 6.6
    const auto reach = std::max<Index> (1, static_cast<Index> (std::lround (std::min (rows, static_cast<double> (off.size())) / 2.0)));
    double sum = off.head (reach).sum(), largest = std::abs (sum);
    for (Index i = reach; i < off.size(); ++i)
    {
        sum += off[i] - off[i - reach];
        largest = std::max (largest, std::abs (sum));
    }
    return largest > most * deviation * std::sqrt (static_cast<double> (reach));
}

/// Takes the noise out of the position, unless this would cut corners, as those of strokes at a constant speed.
ColumnNoise smoothPosition (Drag& drag, std::vector<std::string>& notes)
{
    constexpr double none = 2e-5;   // share of the range
    const double first = drag.position[0];
    const VectorXd from_first = Eigen::Map<const VectorXd> (drag.position.data(), static_cast<Index> (drag.size())).array() - first;
    const auto curve = detail::smoothed (from_first);
    const VectorXd off = from_first - curve.values;
    const double deviation = commonDeviation (off, curve.rows);
    if (! (deviation > none * drag.range)) return {};
    if (cutsCorners (off, curve.rows, deviation)) return { deviation, 0.0 };
    for (std::size_t i = 0; i < drag.size(); ++i)
        drag.position[i] = first + curve.values[static_cast<Index> (i)];
    notes.push_back ("the position has noise of " + roundedText (1e6 * curve.noise, 2) + " um rms, so it is smoothed over about "
                     + roundedText (std::round (curve.rows), 3) + " rows; the intervals leave out slower errors of the position");
    return { curve.noise, curve.weight };
}

/// Takes the noise out of the load.
ColumnNoise smoothLoad (Drag& drag, std::vector<std::string>& notes)
{
    constexpr double none = 1e-5;   // relative to the load
    const auto curve = detail::smoothed (Eigen::Map<const VectorXd> (drag.load.data(), static_cast<Index> (drag.size())));
    if (! (curve.noise > none)) return {};
    for (std::size_t i = 0; i < drag.size(); ++i)
        drag.load[i] = std::max (0.0, curve.values[static_cast<Index> (i)]);
    notes.push_back ("the load has noise of " + roundedText (curve.noise * drag.reference_load, 2) + " N rms, so it is smoothed over about "
                     + roundedText (std::round (curve.rows), 3) + " rows; the intervals leave out slower errors of the load");
    return { curve.noise, curve.weight };
}

/// The best of a coarse grid: mu and offset by linear least squares for each shape.
struct DragStart
{
    DragShape shape;
    double mu = 0.1, offset = 0.0, error = std::numeric_limits<double>::infinity();
};

/// No start has mu above 0 if the force does not depend on the movement.
DragStart coarse (const Drag& drag, BristleAdhesion adhesion, std::size_t rows, const FitCourse* course)
{
    constexpr int lengths = 18;
    constexpr double faint = 1e-6;   // share of the recorded force
    const double least = faint * detail::rootMeanSquare (drag.force) * std::sqrt (static_cast<double> (rows));
    const auto n = static_cast<double> (rows);
    const Eigen::Map<const VectorXd> force (drag.force.data(), static_cast<Index> (rows));
    DragStart best;
    const auto yields = adhesion == BristleAdhesion::dupont ? std::vector { 0.2, 0.5, 0.8 } : std::vector { 1.0 };
    for (int i = 0; i < lengths; ++i)
        for (const double break_away : yields)
            for (const double first : { -0.9, 0.0, 0.9 })
            {
                if (detail::isCancelled (course)) return {};
                const DragShape shape { adhesion, drag.range * math::pow (10.0, -3.0 + 2.9 * i / (lengths - 1)), break_away, first };
                const VectorXd unit = drag.reference_load * dragAlong (drag, shape, rows);
                const double mean_unit = drag.goes_both_ways ? unit.sum() / n : 0.0, mean = drag.goes_both_ways ? force.sum() / n : 0.0;
                const VectorXd moved = unit.array() - mean_unit;
                const double mu = moved.dot ((force.array() - mean).matrix()) / moved.squaredNorm();
                const double offset = mean - mu * mean_unit, error = (force - mu * unit).array().operator- (offset).matrix().squaredNorm();
                if (mu * moved.norm() > least && error < best.error) best = { shape, mu, offset, error };
            }
    return best;
}

struct FoundDrag
{
    BristleAdhesion adhesion {};
    detail::LeastSquaresFit fit;
    double score = 0.0;   // BIC
};

/// Fits for the adhesion functions, the best first. BIC penalises a function that has an additional parameter.
std::vector<FoundDrag> search (const Drag& drag, FitCourse* course)
{
    constexpr std::array all { BristleAdhesion::stick, BristleAdhesion::dupont, BristleAdhesion::ramp, BristleAdhesion::dahl };
    constexpr double hopeless = 2.0;   // functions whose coarse sum of squares is larger than this many times the smallest one are not refined
    std::array<DragStart, all.size()> starts;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        if (detail::isCancelled (course)) return {};
        starts[i] = coarse (drag, all[i], drag.size(), course);
        least = std::min (least, starts[i].error);
        detail::setShare (course, 0.1 * static_cast<double> (i + 1));
    }
    std::vector<FoundDrag> found;
    double independent = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i)
    {
        detail::setShare (course, 0.4 + 0.1 * static_cast<double> (i));
        if (! std::isfinite (starts[i].error) || ! (starts[i].error <= hopeless * least) || detail::isCancelled (course)) continue;
        const DragSearch search (drag, all[i], drag.size(), course);
        auto fit = detail::minimise (search.problem(), search.start (starts[i].shape, starts[i].mu, starts[i].offset));
        if (! fit.x.allFinite() || ! fit.residual.allFinite()) continue;
        if (independent == 0.0) independent = std::max (20.0, detail::independentRows (fit.residual));
        const double score = independent * math::log (fit.sumToCompare()) + static_cast<double> (search.parameters()) * math::log (independent);
        found.push_back ({ all[i], std::move (fit), score });
    }
    std::ranges::sort (found, {}, &FoundDrag::score);
    return found;
}

/// Whether the force follows what is in these rows and was smoothed out of those of a fit. Only its changes from row to row tell: a slow part that the
/// model lacks, such as viscous friction, may fit better to rows with noise.
bool areClearlyBetter (const Drag& drag, const FoundDrag& found, FitCourse* course)
{
    constexpr double clear = 20.0;   // e^10 times as likely
    const DragSearch same (drag, found.adhesion, drag.size(), course);
    const auto fit = detail::minimise (same.problem(), found.fit.x);
    return static_cast<double> (drag.size()) * math::log (found.fit.changesToCompare() / fit.changesToCompare()) > clear;
}

/// The fits for the load as recorded, if the force follows what the smoothing takes out of it; else for the smoothed load.
std::vector<FoundDrag> searchLoads (Drag& drag, const RecordedDrag& recorded, ColumnNoise& noise, std::vector<std::string>& notes, FitCourse* course)
{
    auto raw = drag;
    noise = recorded.load.empty() ? ColumnNoise {} : smoothLoad (drag, notes);
    auto found = search (drag, course);
    if (! (noise.weight > 0.0) || detail::isCancelled (course)) return found;
    if (! found.empty() && (! areClearlyBetter (raw, found.front(), course) || detail::isCancelled (course))) return found;
    notes.back() = "the load changes from row to row by " + roundedText (noise.deviation * drag.reference_load, 2)
                   + " N rms, and the force follows it; the intervals leave out errors of the load";
    noise = {};
    drag = std::move (raw);
    return search (drag, course);
}

/// The fits for the position as recorded, if the force follows what the smoothing takes out of it; else for the smoothed position.
std::vector<FoundDrag> searchColumns (Drag& drag, const RecordedDrag& recorded, DragNoise& noise, std::vector<std::string>& notes, FitCourse* course)
{
    auto raw = drag;
    const auto earlier = notes.size();
    noise.position = smoothPosition (drag, notes);
    auto found = searchLoads (drag, recorded, noise.load, notes, course);
    if (! (noise.position.weight > 0.0) || detail::isCancelled (course)) return found;
    auto sharp = drag;
    sharp.position = raw.position;
    if (! found.empty() && (! areClearlyBetter (sharp, found.front(), course) || detail::isCancelled (course))) return found;
    notes.resize (earlier);
    notes.push_back ("the position changes from row to row by " + roundedText (1e6 * noise.position.deviation, 2)
                     + " um rms, and the force follows it; the intervals leave out errors of the position");
    drag = std::move (raw);
    noise = {};
    return searchLoads (drag, recorded, noise.load, notes, course);
}

/// The mean squares of what the noise that is left in a smoothed column changes in ln mu, ln d_max and ln stiffness: by one step of Gauss & Newton, where
/// the noise becomes twice as large (Cook & Stefanski 1994).
Eigen::Vector3d varianceOf (std::vector<double> Drag::*column, const Drag& drag, const ColumnNoise& noise, const FoundDrag& found)
{
    constexpr int draws = 8;
    constexpr double more = std::numbers::sqrt3;   // makes noise twice as large
    Eigen::Vector3d variance = Eigen::Vector3d::Zero();
    if (! (noise.weight > 0.0)) return variance;
    const DragSearch search (drag, found.adhesion, drag.size(), nullptr);
    const VectorXd modelled = search.modelled (found.fit.x, drag.size());
    const Eigen::MatrixXd influence = detail::influenceOf (found.fit);
    Random random { 1 };
    for (int i = 0; i < draws; ++i)
    {
        VectorXd error (modelled.size());
        for (double& e : error)
            e = more * noise.deviation * random.normal();
        error = detail::smoothed (error, noise.weight);
        auto noisy = drag;
        for (std::size_t k = 0; k < drag.size(); ++k)
            (noisy.*column)[k] += error[static_cast<Index> (k)];   // a load below 0 counts as 0
        const DragSearch with_noise (noisy, found.adhesion, drag.size(), nullptr);
        const VectorXd off = influence * (modelled - with_noise.modelled (found.fit.x, drag.size()));
        const Eigen::Vector3d change { off[0], off[1], off[0] - off[1] };
        variance += change.cwiseProduct (change) / draws;
    }
    return variance;
}

/// Deviations of ln mu, ln d_max and ln stiffness for one adhesion function; infinite if the recording does not determine them.
Eigen::Vector3d deviations (const detail::LeastSquaresFit& fit)
{
    const auto covariance = detail::covarianceOf (fit);
    return { std::sqrt (covariance (0, 0)), std::sqrt (covariance (1, 1)), std::sqrt (detail::varianceAlong (covariance, 0, Eigen::Vector2d { 1.0, -1.0 })) };
}

/// Adhesion functions that fit almost as well widen the intervals, each weighted by its probability (Buckland, Burnham & Augustin 1997).
void reportDrag (const Drag& drag, const DragNoise& noise, const std::vector<FoundDrag>& all, FrictionFit& result)
{
    const auto& best = all.front();
    const DragSearch search (drag, best.adhesion, drag.size(), nullptr);
    const auto& x = best.fit.x;
    const auto covariance = detail::covarianceOf (best.fit);
    const double freedom = detail::independentRows (best.fit.residual) - static_cast<double> (search.parameters());
    Eigen::Vector3d variance = Eigen::Vector3d::Zero();
    double sum = 0.0;
    for (const auto& other : all)
    {
        const double weight = math::exp (-0.5 * std::min (100.0, other.score - best.score));
        if (weight < 1e-3) continue;
        const auto spread = deviations (other.fit);
        const double mu = other.fit.x[0] - x[0], d_max = other.fit.x[1] - x[1];
        const Eigen::Vector3d off { mu, d_max, mu - d_max };
        variance += weight * (spread.cwiseProduct (spread) + off.cwiseProduct (off));
        sum += weight;
    }
    const Eigen::Vector3d of_noise = varianceOf (&Drag::load, drag, noise.load, best) + varianceOf (&Drag::position, drag, noise.position, best),
                          deviation = (variance / sum + of_noise).cwiseSqrt();
    auto& values = result.report.values;
    values = { detail::withLogInterval ("mu", "", result.mu, deviation[0], freedom),
               detail::withLogInterval ("d_max", "m", result.d_max, deviation[1], freedom),
               detail::withLogInterval ("stiffness", "N/m", result.stiffness(), deviation[2], freedom) };
    if (search.yields() > 0)
    {
        const Index i = search.parameters() - 1;
        const double half_width = detail::halfWidth95 (freedom) * std::sqrt (covariance (i, i));
        values.push_back ({ "break_away", "", result.break_away, DragSearch::share (x[i] - half_width), DragSearch::share (x[i] + half_width), false });
    }
    if (search.offsets() > 0)
        values.push_back (detail::withInterval ("zero of the force", "N", result.offset, std::sqrt (covariance (3, 3)) * drag.reference_load, freedom, false));
}

/// Tells of noise of a position that was not smoothed. It lets a sliding contact relax, so d_max and the adhesion are biased.
void reportPosition (const ColumnNoise& noise, double d_max, FitReport& report)
{
    constexpr double harmless = 0.002, most = 0.005;   // shares of d_max
    if (noise.weight > 0.0 || ! (noise.deviation > harmless * d_max)) return;
    const auto size = "the position has noise of about " + roundedText (1e6 * noise.deviation, 2) + " um rms, " + percentText (noise.deviation / d_max)
                      + " of d_max";
    report.notes.push_back (size + "; the intervals and the choice of the adhesion leave it out");
    if (noise.deviation > most * d_max)
        report.lacking.push_back (size + ", which biases d_max and the adhesion: smooth the position, use a finer sensor, or stroke without sudden turns");
}

/// Adds a lack if a force proportional to the speed would explain most of what the fit leaves. A constant speed is no different from dry friction, so
/// only the part of the speed counts that does not look like the fitted force.
void reportSpeed (const Drag& drag, const VectorXd& modelled, FitReport& report)
{
    constexpr double most_of_it = 0.5, noticeable = 0.03;   // shares of the squared residual, and of the recorded force
    const auto n = static_cast<Index> (drag.size()), reach = std::max<Index> (1, n / 400);
    VectorXd speed (n);   // a displacement per row
    for (Index i = 0; i < n; ++i)
    {
        const auto before = std::max<Index> (0, i - reach), after = std::min (n - 1, i + reach);
        speed[i] = (drag.position[static_cast<std::size_t> (after)] - drag.position[static_cast<std::size_t> (before)]) / static_cast<double> (after - before);
    }
    const VectorXd left = Eigen::Map<const VectorXd> (drag.force.data(), n) - modelled, dry = modelled.array() - modelled.mean();
    const VectorXd other = speed - (speed.dot (dry) / std::max (1e-300, dry.squaredNorm())) * dry;
    const double along = left.dot (other), share = along * along / std::max (1e-300, left.squaredNorm() * other.squaredNorm());
    if (share < most_of_it || std::sqrt (share) * report.residual < noticeable * report.size) return;
    report.lacking.push_back (std::string ("a force that ") + (along < 0.0 ? "grows" : "falls") + " with the speed would explain " + percentText (share)
                              + " of what the model leaves, and the model has none");
}
}   // namespace

std::vector<double> FrictionFit::forceAlong (const RecordedDrag& recorded) const
{
    Drag drag { .position = recorded.position, .force = {}, .load = recorded.load };
    if (drag.load.empty()) drag.load.assign (drag.size(), recorded.assumed_load);
    for (double& load : drag.load)
        load = std::max (0.0, load / reference_load);
    const VectorXd force = (mu * reference_load) * dragAlong (drag, { adhesion, d_max, break_away, first_stretch }, drag.size());
    return { force.begin(), force.end() };
}

Result<FrictionFit> fitFriction (const RecordedDrag& recorded, FitCourse* course)
{
    FrictionFit result;
    auto& report = result.report;
    auto read = dragOf (recorded, report.notes);
    if (! read) return read.error();
    auto& drag = *read;
    const auto n = drag.size();

    DragNoise noise;
    const auto all = searchColumns (drag, recorded, noise, report.notes, course);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    if (all.empty())
        return fitError ("fit/no_friction", "the force does not depend on the movement as friction does",
                         "check the columns: the force along the stroke in N, the position in m");

    const auto& found = all.front();
    const DragSearch search (drag, found.adhesion, n, course), first_half (drag, found.adhesion, n / 2, course);
    const auto& x = found.fit.x;
    const auto half = detail::minimise (first_half.problem(), x);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    const auto shape = search.shape (x);
    result.adhesion = found.adhesion;
    result.mu = search.mu (x);
    result.d_max = shape.d_max;
    result.break_away = shape.break_away;
    result.first_stretch = shape.first_stretch;
    result.reference_load = drag.reference_load;
    result.offset = search.offset (x);

    reportDrag (drag, noise, all, result);

    const VectorXd modelled = search.modelled (x, n), predicted = search.modelled (half.x, n);
    const Eigen::Map<const VectorXd> force (drag.force.data(), static_cast<Index> (n));
    const auto second = static_cast<Index> (n - n / 2);
    report.rows = n;
    report.residual_unit = "N";
    report.residual = std::sqrt (found.fit.sum() / static_cast<double> (n));
    report.left_out_residual = std::sqrt ((force - predicted).tail (second).squaredNorm() / static_cast<double> (second));
    report.size = detail::rootMeanSquare (drag.force);
    auto moved = drag.position, recorded_at = recorded.position;   // strokes are often a small part of the distance to the zero of the sensor
    for (auto* column : { &moved, &recorded_at })
        for (double& at : *column)
            at -= recorded.position[0];
    report.picture = { "displacement",
                       "m",
                       "friction force",
                       "N",
                       { { "recorded", recorded_at, drag.force, true }, { "fitted", moved, { modelled.begin(), modelled.end() } } } };
    reportPosition (noise.position, result.d_max, report);
    reportSpeed (drag, modelled, report);
    judge (report,
           "Record at least three slow strokes back and forth, each several times longer than the distance that the contact stretches "
           "before it slides.");
    return result;
}

}   // namespace tactus
