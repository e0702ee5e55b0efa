// SPDX-License-Identifier: MIT
#include "shock_fit.hpp"
#include "least_squares.hpp"
#include "smooth_column.hpp"

#include <tactus/kit/free_impact.hpp>
#include <tactus/kit/math/math.hpp>
#include <tactus/text/number_text.hpp>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace tactus
{

namespace
{
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr std::size_t fewest_impact_rows = 8;

/// The contact around the deepest row, in the order of time.
struct Contact
{
    std::vector<double> d {}, f {}, t {}, rate {};   // m, N, s, m/s; t may be empty
    std::size_t first_row = 0, last_row = 0;         // of the recording, with a depth above 0

    std::size_t size() const noexcept { return d.size(); }

    /// The integral of a force over depth, along the path.
    template <typename Force>
    double work (const Force& force, std::size_t end) const
    {
        double sum = 0.0;
        for (std::size_t i = 1; i < end; ++i)
            sum += 0.5 * (force (i - 1) + force (i)) * (d[i] - d[i - 1]);
        return sum;
    }

    template <typename Force>
    double work (const Force& force) const
    {
        return work (force, size());
    }

    std::size_t deepest() const { return static_cast<std::size_t> (std::ranges::max_element (d) - d.begin()); }
};

Result<> checkImpact (const RecordedLoop& loop)
{
    const auto n = loop.depth.size();
    if (n < fewest_impact_rows || loop.force.size() != n || (! loop.time.empty() && loop.time.size() != n))
        return detail::fitError ("fit/too_short",
                                 "the recording has " + std::to_string (n) + " rows; a fit needs at least " + std::to_string (fewest_impact_rows),
                                 "record the whole contact, from before the touch until after the tool has left");
    for (const auto* column : { &loop.depth, &loop.force, &loop.time })
        if (! std::ranges::all_of (*column, [] (double v) { return std::isfinite (v); }))
            return detail::fitError ("fit/not_finite", "the recording contains nan or inf", "leave out the rows without a measurement");
    if (std::ranges::adjacent_find (loop.time, std::ranges::greater_equal {}) != loop.time.end())
        return detail::fitError ("fit/time", "the times do not increase from row to row", "sort the rows by time, or leave out the column t");
    return {};
}

/// Adds the point between a row outside and a row inside at which the depth and the force are 0. `deeper` is the row next to `inside`:
/// the time is extrapolated from these two rows, because the row outside may be much earlier or later.
void addTouch (const RecordedLoop& loop, std::size_t outside, std::size_t inside, std::size_t deeper, Contact& contact)
{
    contact.d.push_back (0.0);
    contact.f.push_back (0.0);
    if (loop.time.empty()) return;
    const auto& [d, f, t] = loop;
    const double then = t[inside] - d[inside] * (t[deeper] - t[inside]) / (d[deeper] - d[inside]);
    const auto [earliest, latest] = std::minmax (t[outside], t[inside]);
    const bool is_between = then > earliest && then < latest;
    contact.t.push_back (is_between ? then : t[outside] + d[outside] / (d[outside] - d[inside]) * (t[inside] - t[outside]));
}

Result<Contact> contactOf (const RecordedLoop& loop)
{
    const auto& d = loop.depth;
    const auto deepest = static_cast<std::size_t> (std::ranges::max_element (d) - d.begin());
    if (! (d[deepest] > 0.0)) return detail::fitError ("fit/no_contact", "the depth is never above 0", "give the depth in m, positive inside the object");
    auto first = deepest, last = deepest;
    while (first > 0 && d[first - 1] > 0.0)
        --first;
    while (last + 1 < d.size() && d[last + 1] > 0.0)
        ++last;

    const double nothing = 1e-3 * d[deepest];   // a row this close to the surface is the touch itself
    if (deepest == first || deepest == last || last - first + 1 < fewest_impact_rows)
        return detail::fitError (
            "fit/no_loop", "the contact around the deepest row (" + std::to_string (last - first + 1) + " rows) is too short, or does not go both in and out",
            "record the whole contact, with at least " + std::to_string (fewest_impact_rows) + " rows inside the object");

    Contact contact { .first_row = first, .last_row = last };
    if (first > 0 && d[first] > nothing) addTouch (loop, first - 1, first, first + 1, contact);
    for (auto i = first; i <= last; ++i)
    {
        contact.d.push_back (d[i]);
        contact.f.push_back (loop.force[i]);
        if (! loop.time.empty()) contact.t.push_back (loop.time[i]);
    }
    if (last + 1 < d.size() && d[last] > nothing) addTouch (loop, last + 1, last, last - 1, contact);
    return contact;
}

/// The number of rows from a touch over which the speed at the touch is estimated: noise of the depth counts less over more rows, but the speed must
/// change little.
std::size_t rowsOfTouch (const Contact& c)
{
    constexpr std::size_t share = 30, least = 3, most = 100;   // one row in 30
    return std::clamp (c.size() / share, least, most);
}

/// The speed at the first of these rows, or at the last one, from the parabola that is nearest to them.
double touchRate (const Contact& c, std::size_t first, std::size_t touch)
{
    const auto rows = rowsOfTouch (c);
    const double span = c.t[first + rows - 1] - c.t[first];
    Eigen::MatrixXd powers (static_cast<Eigen::Index> (rows), 3);
    for (std::size_t i = 0; i < rows; ++i)
    {
        const double u = (c.t[first + i] - c.t[touch]) / span;
        powers.row (static_cast<Eigen::Index> (i)) << 1.0, u, u * u;
    }
    const Eigen::Map<const Eigen::VectorXd> depth (c.d.data() + first, powers.rows());
    return Eigen::VectorXd (powers.householderQr().solve (depth))[1] / span;
}

/// The speed at each row, from a parabola through the row and its neighbours; at the touches, from one through more rows.
void setRatesByTime (Contact& c)
{
    const auto slope = [&] (std::size_t i) { return (c.d[i + 1] - c.d[i]) / (c.t[i + 1] - c.t[i]); };
    const auto last = c.size() - 1;
    c.rate.resize (c.size());
    for (std::size_t i = 1; i < last; ++i)
    {
        const double before = c.t[i] - c.t[i - 1], after = c.t[i + 1] - c.t[i];
        c.rate[i] = (slope (i - 1) * after + slope (i) * before) / (before + after);
    }
    c.rate[0] = touchRate (c, 0, 0);
    c.rate[last] = touchRate (c, c.size() - rowsOfTouch (c), last);
}

/// The speed at each row of a free impact, from the energy that the mass has lost.
void setRatesByEnergy (Contact& c, double mass)
{
    const auto deepest = c.deepest();
    const auto recorded = [&] (std::size_t i) { return c.f[i]; };
    const double most = c.work (recorded, deepest + 1);
    double lost = 0.0;
    c.rate.assign (c.size(), 0.0);
    for (std::size_t i = 0; i < c.size(); ++i)
    {
        if (i > 0) lost += 0.5 * (c.f[i - 1] + c.f[i]) * (c.d[i] - c.d[i - 1]);
        c.rate[i] = (i < deepest ? 1.0 : -1.0) * std::sqrt (std::max (0.0, 2.0 * (most - lost) / mass));
    }
}

/// The momentum that the mass has lost, divided by the speed that it has lost.
double massByTime (const Contact& c)
{
    double impulse = 0.0;
    for (std::size_t i = 1; i < c.size(); ++i)
        impulse += 0.5 * (c.f[i - 1] + c.f[i]) * (c.t[i] - c.t[i - 1]);
    return impulse / (c.rate.front() - c.rate.back());
}

/// The variance of the errors of the depth, in m^2: how far each row lies from the cubic through the two rows before and the two rows after it.
/// The touches are left out, because they were not measured.
double depthVariance (const Contact& c)
{
    double sum = 0.0, rows = 0.0;
    for (std::size_t i = 3; i + 3 < c.size(); ++i)
    {
        const std::array around { i - 2, i - 1, i + 1, i + 2 };
        double off = c.d[i], size = 1.0;
        for (const auto j : around)
        {
            double weight = 1.0;
            for (const auto k : around)
                if (k != j) weight *= (c.t[i] - c.t[k]) / (c.t[j] - c.t[k]);
            off -= weight * c.d[j];
            size += weight * weight;
        }
        sum += off * off / size;
        rows += 1.0;
    }
    return sum / std::max (1.0, rows);
}

/// Noise of the depth would be in the speed and in the way at the same time, so that a weak damping would have the recorded area. If the rows of the contact
/// are evenly spaced, takes their depth from a smooth curve; then returns its noise, in m.
std::optional<double> smoothDepth (RecordedLoop& loop, const Contact& c)
{
    constexpr double evenly = 0.01, nothing = 3e-5, followed = 1.5;
    const auto first = c.first_row, rows = c.last_row - first + 1;
    const double spacing = (loop.time[c.last_row] - loop.time[first]) / static_cast<double> (rows - 1), variance = depthVariance (c);
    for (std::size_t i = first; i < c.last_row; ++i)
        if (std::abs (loop.time[i + 1] - loop.time[i] - spacing) > evenly * spacing) return std::nullopt;
    if (! (std::sqrt (variance) > nothing * c.d[c.deepest()])) return std::nullopt;
    const auto curve = detail::smoothed (Eigen::Map<const Eigen::VectorXd> (&loop.depth[first], static_cast<Eigen::Index> (rows)));
    if (curve.noise * curve.noise > followed * followed * variance) return std::nullopt;   // it cuts corners
    std::ranges::copy (curve.values, &loop.depth[first]);
    return curve.noise;
}

/// Variances by the errors of the depth.
struct DepthErrors
{
    double speed = 0.0, mass = 0.0;   // of the speed at the touch, in (m/s)^2, and of the mass by the times, in kg^2
};

/// The errors of the depth matter at the touches, where the speeds come from a few rows each.
DepthErrors depthErrors (const RecordedLoop& loop, const Contact& c)
{
    const auto reach = rowsOfTouch (c);
    const double variance = depthVariance (c), step = std::sqrt (variance);
    if (! (step > 0.0)) return {};
    auto moved = loop;
    const auto estimatesWith = [&] (std::size_t row, double by) {
        moved.depth[row] = loop.depth[row] + by;
        auto contact = contactOf (moved);
        moved.depth[row] = loop.depth[row];
        if (! contact) return Eigen::Array2d { inf, inf };
        setRatesByTime (*contact);
        return Eigen::Array2d { contact->rate.front(), massByTime (*contact) };
    };
    Eigen::Array2d squares = Eigen::Array2d::Zero();
    for (std::size_t row = c.first_row > 0 ? c.first_row - 1 : 0; row < loop.depth.size() && row <= c.last_row + 1; ++row)
    {
        if (row > c.first_row + reach && row + reach < c.last_row) continue;
        const Eigen::Array2d slope = (estimatesWith (row, step) - estimatesWith (row, -step)) / (2.0 * step);
        if (slope.isFinite().all()) squares += slope * slope;   // with this row elsewhere, there may be no contact to estimate from
    }
    return { variance * squares[0], variance * squares[1] };
}

/// The growth of the damping with depth.
enum class Damping
{
    as_spring,   // D = lambda K
    as_depth     // D = B0 d
};

/// A law with K = k d^n and the damping force c d^q d'.
struct Candidate
{
    Damping damping {};
    double n = 1.0, k = 0.0, c = 0.0;
    double error = inf;   // sum of squares, N^2

    double q() const noexcept { return damping == Damping::as_spring ? n : 1.0; }

    double force (double d, double rate) const noexcept
    {
        const double depth = std::max (0.0, d), elastic = math::pow (depth, n);
        return std::max (0.0, k * elastic + c * rate * (damping == Damping::as_spring ? elastic : depth));
    }
};

/// The rows at which a law has a force above 0.
std::vector<bool> pushing (const Contact& x, const Candidate& law)
{
    std::vector<bool> pushes;
    for (std::size_t i = 0; i < x.size(); ++i)
        pushes.push_back (law.force (x.d[i], x.rate[i]) > 0.0);
    return pushes;
}

/// The best k and c for the power n, if the force is 0 at all rows that do not push, and may pull at the others. Because the law must have the given
/// area, only k is free.
Candidate bestOf (const Contact& x, const std::vector<bool>& pushes, Damping damping, double n, double area)
{
    Candidate best { .damping = damping, .n = n };
    const auto power = [&] (std::size_t i, double of) { return pushes[i] ? math::pow (std::max (0.0, x.d[i]), of) : 0.0; };
    const auto elastic = [&] (std::size_t i) { return power (i, n); };
    const auto viscous = [&] (std::size_t i) { return power (i, best.q()) * x.rate[i]; };
    const double spring = x.work (elastic), damper = x.work (viscous);
    double down = 0.0, across = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const double v = viscous (i), free = elastic (i) - v * spring / damper, fixed = v * area / damper;
        down += free * free;
        across += free * (x.f[i] - fixed);
    }
    best.k = across / down;
    best.c = (area - best.k * spring) / damper;
    best.error = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const double off = x.f[i] - best.k * elastic (i) - best.c * viscous (i);
        best.error += off * off;
    }
    if (! (best.k > 0.0) || ! std::isfinite (best.error)) best.error = inf;
    return best;
}

/// Tries powers n in coarse steps, then in finer steps around the best one. A cancelled search returns the best so far.
Candidate bestOf (const Contact& x, const std::vector<bool>& pushes, Damping damping, double area, FitCourse* course)
{
    constexpr double least = 0.5, most = 4.0;
    Candidate best { .damping = damping };
    double from = least, to = most;
    for (double step = 0.1; step > 1e-6; step *= 0.1)
    {
        for (double n = from; n <= to + 0.5 * step && ! detail::isCancelled (course); n += step)
            if (const auto one = bestOf (x, pushes, damping, n, area); one.error < best.error) best = one;
        from = std::max (least, best.n - step);
        to = std::min (most, best.n + step);
    }
    return best;
}

double areaOf (const Contact& x, const Candidate& law)
{
    return x.work ([&] (std::size_t i) { return law.force (x.d[i], x.rate[i]); });
}

/// bestOf() lets the force pull, but the law does not. So this looks for the damping with which the law has the area.
void matchArea (const Contact& x, double area, Candidate& law, FitCourse* course)
{
    double low = 0.0, high = std::max (law.c, 1e-12 * law.k);
    const auto areaAt = [&] (double c) {
        law.c = c;
        return areaOf (x, law);
    };
    for (int i = 0; i < 100 && ! detail::isCancelled (course) && areaAt (high) < area; ++i)
        high *= 2.0;
    for (int i = 0; i < 200 && low < high && ! detail::isCancelled (course); ++i)
    {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) break;
        (areaAt (middle) < area ? low : high) = middle;
    }
    law.c = high;
}

/// The best law of this kind. Near the end, a strong damping would pull: the force is 0 at these rows, which are found by repeating the search.
Candidate bestOf (const Contact& x, Damping damping, double area, FitCourse* course)
{
    constexpr int most_searches = 6;
    std::vector<bool> pushes (x.size(), true);
    Candidate best;
    for (int i = 0; i < most_searches && ! detail::isCancelled (course); ++i)
    {
        detail::setShare (course, (damping == Damping::as_spring ? 0.05 : 0.35) + 0.05 * i);
        auto law = bestOf (x, pushes, damping, area, course);
        if (! std::isfinite (law.error)) break;
        matchArea (x, area, law, course);
        best = law;
        auto now = pushing (x, law);
        if (now == pushes) break;
        pushes = std::move (now);
    }
    return best;
}

/// Recorded minus fitted forces.
Eigen::VectorXd residualOf (const Contact& x, const Candidate& law)
{
    Eigen::VectorXd left (static_cast<Eigen::Index> (x.size()));
    for (std::size_t i = 0; i < x.size(); ++i)
        left[static_cast<Eigen::Index> (i)] = x.f[i] - law.force (x.d[i], x.rate[i]);
    return left;
}

/// D = lambda K, unless D = B0 d is clearly more likely: it has as many parameters, so the sums of squares decide. Both laws must have the recorded
/// area, noise and all. In 300 recordings of lambda K with noise 20 dB below the signal, this alone made B0 d look e^8 times as likely once.
Candidate bestLaw (const Contact& x, double area, FitCourse* course)
{
    constexpr double clear = 30.0, rounding = 1e-9, alike = 0.05;   // e^15 times as likely; a share of the force; around n = 1, both are the same law
    std::array<Candidate, 2> laws;
    std::array<Eigen::VectorXd, 2> left;
    for (std::size_t i = 0; i < laws.size(); ++i)
    {
        laws[i] = bestOf (x, i == 0 ? Damping::as_spring : Damping::as_depth, area, course);
        if (std::isfinite (laws[i].error)) left[i] = residualOf (x, laws[i]);
    }
    if (left[1].size() == 0 || std::abs (laws[0].n - 1.0) < alike) return laws[0];
    if (left[0].size() == 0) return laws[1];
    const double least = rounding * rounding * Eigen::Map<const Eigen::VectorXd> (x.f.data(), left[0].size()).squaredNorm();
    const double independent = std::max (20.0, detail::independentRows (left[0]));
    const double gain = independent * math::log ((left[0].squaredNorm() + least) / (left[1].squaredNorm() + least));
    return laws[gain > clear ? 1 : 0];
}

/// The energy that a free impact loses with the fitted law.
double playedArea (const Candidate& law, double mass, double speed, double duration, FitCourse* course)
{
    const auto force = [&] (double d, double v) noexcept { return law.force (d, v); };
    for (double longest = duration; longest < 1e6 * duration && ! detail::isCancelled (course); longest *= 4.0)
        if (const auto out = freeImpact (force, mass, speed, longest); out.isKnown()) return 0.5 * mass * (speed * speed - out.speed * out.speed);
    return 0.5 * mass * speed * speed;   // the damping keeps the mass inside
}

/// The weights of the rows in the integral of a force over depth or over time.
Eigen::RowVectorXd weightsOf (const std::vector<double>& along)
{
    Eigen::RowVectorXd w = Eigen::RowVectorXd::Zero (static_cast<Eigen::Index> (along.size()));
    for (std::size_t i = 1; i < along.size(); ++i)
    {
        const auto k = static_cast<Eigen::Index> (i);
        w[k] += 0.5 * (along[i] - along[i - 1]);
        w[k - 1] += 0.5 * (along[i] - along[i - 1]);
    }
    return w;
}

/// The law as F = K u^n + C u^q d', with u the depth over the largest depth. Of the three directions of (K, n, C), two keep the area, and only these
/// are fitted; the third one follows from the recorded area.
/// `mass_variance`: that of the mass by the errors of the depth, if the mass is estimated.
void reportShock (const Contact& x, const Candidate& law, std::optional<double> mass_variance, ShockFit& fit)
{
    const auto rows = static_cast<Eigen::Index> (x.size());
    const bool as_spring = law.damping == Damping::as_spring;
    const double deepest = x.d[x.deepest()], K = law.k * math::pow (deepest, law.n), C = law.c * math::pow (deepest, law.q());
    Eigen::MatrixXd slopes (rows, 3);
    const Eigen::VectorXd left = residualOf (x, law);
    for (Eigen::Index i = 0; i < rows; ++i)
    {
        const auto k = static_cast<std::size_t> (i);
        const double u = fit.fitted[k] > 0.0 ? std::max (0.0, x.d[k] / deepest) : 0.0, e = u > 0.0 ? math::pow (u, law.n) : 0.0;
        const double of_power = e * (K + (as_spring ? C * x.rate[k] : 0.0));
        slopes.row (i) << e, u > 0.0 ? of_power * math::log (u) : 0.0, (as_spring ? e : u) * x.rate[k];
    }
    const Eigen::RowVectorXd weights = weightsOf (x.d);
    const Eigen::Vector3d size = slopes.colwise().norm().cwiseInverse().transpose();
    const Eigen::MatrixXd J = slopes * size.asDiagonal();
    const Eigen::RowVector3d area = weights * J;
    const Eigen::Vector3d q = area.transpose() / area.squaredNorm();
    const Eigen::Matrix<double, 3, 2> free = Eigen::FullPivLU<Eigen::RowVector3d> (area).kernel();
    const Eigen::MatrixXd M = J * free;
    const Eigen::MatrixXd solve = (M.transpose() * M).ldlt().solve (M.transpose());
    const Eigen::MatrixXd influence = size.asDiagonal() * (free * (solve - (solve * (J * q)) * weights) + q * weights);
    const Eigen::Matrix3d covariance = detail::covarianceOf (influence, left, 3);
    const double freedom = detail::independentRows (left) - 3.0, of_k = std::sqrt (covariance (0, 0)) / K;

    auto& report = fit.report;
    report.values.push_back (detail::withLogInterval ("stiffness at the deepest point", "N/m", K / deepest, of_k, freedom));
    report.values.push_back (detail::withInterval ("power of the law", "", law.n, std::sqrt (covariance (1, 1)), freedom));
    if (as_spring)
    {
        const double lambda = C / K;
        const Eigen::Vector3d of_lambda { -lambda / K, 0.0, 1.0 / K };
        report.values.push_back (
            detail::withInterval ("dissipation", "s/m", lambda, std::sqrt (std::max (0.0, of_lambda.dot (covariance * of_lambda))), freedom));
    }
    else
    {
        report.values.push_back (detail::withInterval ("damping per depth", "N*s/m2", C / deepest, std::sqrt (covariance (2, 2)) / deepest, freedom));
        report.notes.push_back ("the damping is proportional to the depth, D = B0 d, which fits clearly better than D = lambda K");
    }
    const Eigen::MatrixXd lost = detail::covarianceOf (weights, left, 3);
    report.values.push_back (detail::withInterval ("lost energy", "J", fit.recorded_area, std::sqrt (lost (0, 0)), freedom, false));
    if (mass_variance)
    {
        const Eigen::MatrixXd of_mass = detail::covarianceOf (weightsOf (x.t) / (x.rate.front() - x.rate.back()), left, 3);
        report.values.push_back (detail::withInterval ("mass", "kg", fit.mass, std::sqrt (of_mass (0, 0) + *mass_variance), freedom));
    }

    // One Gauss-Newton step without the rows that are left out.
    const Eigen::Index block = std::max<Eigen::Index> (1, rows / 50);
    Eigen::VectorXd kept = Eigen::VectorXd::Ones (rows);
    for (Eigen::Index i = 0; i < rows; ++i)
        if (i / block % 5 == 2) kept[i] = 0.0;
    const Eigen::MatrixXd part = kept.asDiagonal() * M;
    const Eigen::VectorXd off = left - M * (part.transpose() * part).ldlt().solve (part.transpose() * left);
    const double count = static_cast<double> (rows) - kept.sum();
    report.rows = x.size();
    report.residual_unit = "N";
    report.residual = fit.residual;
    report.left_out_residual = count > 0.0 ? std::sqrt ((off.cwiseProduct (Eigen::VectorXd::Ones (rows) - kept)).squaredNorm() / count) : fit.residual;
    report.size = detail::rootMeanSquare (fit.recorded);
    report.picture = { "depth", "m", "force", "N", { { "recorded", x.d, fit.recorded, true }, { "fitted, with the same area", x.d, fit.fitted } } };
    judge (report, "Record the whole impact of a tool that moves freely, with at least 50 rows during the contact.");
}
}   // namespace

Result<ShockFit> fitShock (const RecordedLoop& loop, double mass, FitCourse* course)
{
    if (auto checked = checkImpact (loop); ! checked) return checked.error();
    auto found = contactOf (loop);
    if (! found) return found.error();
    const bool has_times = ! loop.time.empty();
    auto smooth = loop;
    const auto noise = has_times ? smoothDepth (smooth, *found) : std::nullopt;
    const auto recorded = *found;
    if (auto again = noise ? contactOf (smooth) : found) found = std::move (again);
    auto& x = *found;

    if (has_times) setRatesByTime (x);
    const bool estimates_mass = ! (mass > 0.0) && has_times;
    if (estimates_mass) mass = massByTime (x);
    if (! (mass > 0.0) || ! std::isfinite (mass))
        return detail::fitError ("fit/mass", "the mass that rebounded cannot be found from the recording", "give the mass, for example --mass \"50 g\"");
    if (! has_times) setRatesByEnergy (x, mass);

    const double area = x.work ([&] (std::size_t i) { return x.f[i]; });
    if (! (area >= 0.0))
        return detail::fitError ("fit/gains_energy", "the recorded force is larger on the way out than on the way in, so the object would create energy",
                                 "check the order of the rows and the signs: depth and force are positive inside the object");
    const auto law = bestLaw (x, area, course);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    if (! std::isfinite (law.error))
        return detail::fitError ("fit/no_spring", "no law k d^n with damping fits the recording",
                                 "check the columns: the force must grow with depth, in N and m");
    detail::setShare (course, 0.7);

    ShockFit fit;
    fit.stiffness = { .kind = Law::Kind::power, .a = law.k, .b = law.n };
    if (law.damping == Damping::as_spring)
        fit.damping = { .kind = Law::Kind::dissipation, .a = law.c / law.k };
    else
        fit.damping = { .kind = Law::Kind::power, .a = law.c, .b = 1.0 };
    fit.mass = mass;
    fit.speed = x.rate.front();
    fit.recorded_area = area;
    fit.fitted_area = areaOf (x, law);
    fit.peak = *std::ranges::max_element (x.f);
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        fit.fitted.push_back (law.force (x.d[i], x.rate[i]));
        fit.residual += (x.f[i] - fit.fitted[i]) * (x.f[i] - fit.fitted[i]);
    }
    fit.residual = std::sqrt (fit.residual / static_cast<double> (x.size()));
    if (fit.speed > 0.0) fit.played_area = playedArea (law, mass, fit.speed, 4.0 * x.d[x.deepest()] / fit.speed, course);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    detail::setShare (course, 0.8);
    fit.recorded = x.f;
    const auto errors = has_times ? depthErrors (loop, recorded) : DepthErrors {};
    fit.speed_error = std::sqrt (errors.speed);
    if (noise)
        fit.report.notes.push_back ("the depth has noise of " + roundedText (1e6 * *noise, 2)
                                    + " um rms, so it is smoothed; the intervals leave out slower errors of the depth");
    reportShock (x, law, estimates_mass ? std::optional (errors.mass) : std::nullopt, fit);
    if (detail::isCancelled (course)) return detail::fitCancelled();
    fit.depth = std::move (x.d);
    return fit;
}

}   // namespace tactus
