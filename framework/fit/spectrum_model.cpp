// SPDX-License-Identifier: MIT
#include "spectrum_model.hpp"

#include <tactus/kit/math/math.hpp>

#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/FFT>

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <numeric>

namespace tactus::detail
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double tapered = 0.04;        // share of a stretch at each end
constexpr std::size_t longest = 2048;   // rows of a stretch; longer ones are divided

double taper (std::size_t i, std::size_t n)
{
    const double edge = std::min (static_cast<double> (i) + 0.5, static_cast<double> (n - i) - 0.5) / (tapered * static_cast<double> (n));
    return edge < 1.0 ? 0.5 - 0.5 * math::cos (std::numbers::pi * edge) : 1.0;
}

/// The powers of the lines of a stretch without its mean, from line 0 to half the rate, per mean power of a row.
std::vector<double> linesOf (std::span<const double> y)
{
    const auto n = y.size();
    double mean = 0.0, squares = 0.0;
    for (const double v : y)
        mean += v / static_cast<double> (n);
    std::vector<double> windowed (n), powers;
    for (std::size_t i = 0; i < n; ++i)
    {
        const double h = taper (i, n);
        windowed[i] = h * (y[i] - mean);
        squares += h * h;
    }
    std::vector<std::complex<double>> lines;
    Eigen::FFT<double>().fwd (lines, windowed);
    for (std::size_t j = 0; j < n / 2; ++j)
        powers.push_back (std::norm (lines[j]) / squares);
    return powers;
}

void addStretch (std::span<const double> y, Periodogram& p)
{
    const auto powers = linesOf (y);
    for (std::size_t j = 2; j < powers.size(); ++j)   // the mean was removed
    {
        p.frequency.push_back (2.0 * std::numbers::pi * static_cast<double> (j) / static_cast<double> (y.size()));
        p.power.push_back (powers[j]);
    }
}

/// The largest length up to n whose four highest binary digits may differ from 0, so that its transform is fast.
std::size_t fastLength (std::size_t n)
{
    const int digits = std::max (0, static_cast<int> (std::bit_width (n)) - 4);
    return n >> digits << digits;
}

/// Reflection coefficients by Burg's method over all stretches.
std::vector<double> reflectionsByBurg (const std::vector<std::span<const double>>& stretches, int order)
{
    std::vector<std::vector<double>> forward, backward;
    for (const auto s : stretches)
    {
        const double mean = std::accumulate (s.begin(), s.end(), 0.0) / static_cast<double> (s.size());
        for (auto& v : forward.emplace_back (s.begin(), s.end()))
            v -= mean;
    }
    backward = forward;
    std::vector<double> reflections;
    for (std::size_t m = 1; m <= static_cast<std::size_t> (order); ++m)
    {
        double across = 0.0, power = 0.0;
        for (std::size_t s = 0; s < forward.size(); ++s)
            for (std::size_t i = m; i < forward[s].size(); ++i)
            {
                across += forward[s][i] * backward[s][i - 1];
                power += forward[s][i] * forward[s][i] + backward[s][i - 1] * backward[s][i - 1];
            }
        const double k = power > 0.0 ? 2.0 * across / power : 0.0;
        reflections.push_back (std::clamp (k, -0.9999, 0.9999));
        for (std::size_t s = 0; s < forward.size(); ++s)
            for (std::size_t i = forward[s].size(); i-- > m;)
            {
                const double f = forward[s][i], b = backward[s][i - 1];
                forward[s][i] = f - k * b;
                backward[s][i] = b - k * f;
            }
    }
    return reflections;
}

/// Levinson's recursion.
VectorXd coefficientsOf (const VectorXd& reflections)
{
    VectorXd a (reflections.size());
    for (Index m = 0; m < reflections.size(); ++m)
    {
        const VectorXd before = a.head (m);
        for (Index j = 0; j < m; ++j)
            a[j] = before[j] - reflections[m] * before[m - 1 - j];
        a[m] = reflections[m];
    }
    return a;
}

/// (e^2x - 1) / (e^2x + 1)
double tanh (double x) { return 1.0 - 2.0 / (math::exp (2.0 * std::clamp (x, -9.0, 9.0)) + 1.0); }

/// Cosines and sines of the multiples of all frequencies.
struct Turns
{
    MatrixXd cosine, sine;

    Turns (const Periodogram& p, int most)
        : cosine (static_cast<Index> (p.frequency.size()), most), sine (cosine.rows(), most)
    {
        for (Index i = 0; i < cosine.rows(); ++i)
            for (Index k = 0; k < most; ++k)
            {
                const auto [s, c] = math::sinCos (p.frequency[static_cast<std::size_t> (i)] * static_cast<double> (k + 1));
                cosine (i, k) = c;
                sine (i, k) = s;
            }
    }
};

/// The search for a given order. Parameters: artanh of the reflection coefficients, ln variance and ln floor.
class SpectrumSearch
{
public:
    SpectrumSearch (const Periodogram& p, const Turns& t, Index o, const FitCourse* c) : data (p), turns (t), order (o), course (c) {}

    Index parameters() const { return order + 2; }

    VectorXd coefficients (const VectorXd& x) const
    {
        return coefficientsOf (x.head (order).unaryExpr ([] (double v) { return tanh (v); }));
    }

    LeastSquares problem() const
    {
        return { .rows = turns.cosine.rows(),
                 .residual = [this] (const VectorXd& x, VectorXd& r) { set (x, &r, nullptr); },
                 .jacobian = [this] (const VectorXd& x, MatrixXd& j) {
                     VectorXd r (turns.cosine.rows());
                     set (x, &r, &j); },
                 .course = course };
    }

    /// The derivatives of ln S by the coefficients, by ln variance, and by the floor or its logarithm.
    MatrixXd slopes (const VectorXd& x, bool in_ln = true) const
    {
        const VectorXd a = coefficients (x);
        const double variance = math::exp (x[order]), level = math::exp (x[order + 1]);
        MatrixXd g (turns.cosine.rows(), parameters());
        for (Index i = 0; i < g.rows(); ++i)
        {
            const auto c = turns.cosine.row (i).head (order), s = turns.sine.row (i).head (order);
            const double re = 1.0 - c.dot (a.transpose()), im = s.dot (a.transpose()), gain = re * re + im * im;
            const double power = variance / gain + level;
            g.row (i).head (order) = (2.0 * variance / (gain * gain * power)) * (re * c - im * s);
            g (i, order) = variance / gain / power;
            g (i, order + 1) = (in_ln ? level : 1.0) / power;
        }
        return g;
    }

    /// The power of each line over that of the model, minus 1.
    VectorXd excess (const VectorXd& x) const
    {
        const VectorXd a = coefficients (x);
        const double variance = math::exp (x[order]), level = math::exp (x[order + 1]);
        VectorXd over (turns.cosine.rows());
        for (Index i = 0; i < over.size(); ++i)
        {
            const double re = 1.0 - turns.cosine.row (i).head (order).dot (a.transpose()), im = turns.sine.row (i).head (order).dot (a.transpose());
            over[i] = data.power[static_cast<std::size_t> (i)] / (variance / (re * re + im * im) + level) - 1.0;
        }
        return over;
    }

private:
    void set (const VectorXd& x, VectorXd* residual, MatrixXd* jacobian) const
    {
        const VectorXd a = coefficients (x);
        const double variance = math::exp (std::clamp (x[order], -60.0, 60.0)), level = math::exp (std::clamp (x[order + 1], -60.0, 60.0));
        VectorXd stretch (residual->size());
        for (Index i = 0; i < residual->size(); ++i)
        {
            const double re = 1.0 - turns.cosine.row (i).head (order).dot (a.transpose()), im = turns.sine.row (i).head (order).dot (a.transpose());
            const double u = data.power[static_cast<std::size_t> (i)] / (variance / (re * re + im * im) + level), off = u - 1.0;
            const double deviance = 2.0 * (off - math::log (std::max (u, 1e-300)));
            (*residual)[i] = std::copysign (std::sqrt (std::max (0.0, deviance)), off);
            stretch[i] = std::abs (off) > 1e-4 ? off / (*residual)[i] : 1.0;
        }
        if (! jacobian) return;
        const MatrixXd g = slopes (x);
        jacobian->rightCols (parameters() - order) = -(stretch.asDiagonal() * g.rightCols (parameters() - order));
        MatrixXd turn (order, order);
        constexpr double step = 1e-5;
        for (Index m = 0; m < order; ++m)
        {
            VectorXd above = x, below = x;
            above[m] += step;
            below[m] -= step;
            turn.col (m) = (coefficients (above) - coefficients (below)) / (2.0 * step);
        }
        jacobian->leftCols (order) = -(stretch.asDiagonal() * (g.leftCols (order) * turn));
    }

    const Periodogram& data;
    const Turns& turns;
    Index order;
    const FitCourse* course;
};

/// Cuts stretches into parts of as many rows each.
std::vector<std::vector<std::span<const double>>> quartersOf (const std::vector<std::span<const double>>& stretches)
{
    constexpr std::size_t count_of_parts = quarters, shortest = 32;   // shorter pieces have too few lines
    std::size_t rows = 0, done = 0;
    for (const auto y : stretches)
        rows += y.size();
    std::vector<std::vector<std::span<const double>>> parts (count_of_parts);
    for (auto y : stretches)
        while (! y.empty())
        {
            const auto part = std::min (count_of_parts - 1, done * count_of_parts / rows), end = rows * (part + 1) / count_of_parts;
            const auto count = part + 1 < count_of_parts ? std::clamp<std::size_t> (end - done, 1, y.size()) : y.size();
            if (count >= shortest) parts[part].push_back (y.first (count));
            y = y.subspan (count);
            done += count;
        }
    return parts;
}

/// The contribution of each quarter of the rows to the estimates, by one step of Fisher's scoring. `inverse` is that of the information of all rows,
/// in which the floor counts in units of `power`.
MatrixXd contributionsOf (const std::vector<std::span<const double>>& stretches, const VectorXd& x, Index order, double power, const MatrixXd& inverse)
{
    const auto parts = quartersOf (stretches);
    MatrixXd of_quarters = MatrixXd::Zero (inverse.rows(), static_cast<Index> (parts.size()));
    for (std::size_t q = 0; q < parts.size(); ++q)
    {
        const auto data = periodogramOf (parts[q]);
        if (data.power.empty()) return MatrixXd::Zero (inverse.rows(), of_quarters.cols());
        const Turns turns (data, static_cast<int> (order));
        const SpectrumSearch search (data, turns, order, nullptr);
        MatrixXd g = search.slopes (x, false);
        g.col (order + 1) *= power;
        of_quarters.col (static_cast<Index> (q)) = inverse * (g.transpose() * search.excess (x));
    }
    return of_quarters;
}
}   // namespace

Periodogram periodogramOf (const std::vector<std::span<const double>>& stretches)
{
    Periodogram p;
    for (const auto y : stretches)
    {
        const auto parts = (y.size() + longest - 1) / longest, length = y.size() / parts / 16 * 16;
        for (std::size_t i = 0; i < parts; ++i)
            addStretch (y.subspan (i * length, length), p);
    }
    double squares = 0.0, fourth = 0.0;
    constexpr std::size_t n = 1000;
    for (std::size_t i = 0; i < n; ++i)
    {
        const double h = taper (i, n);
        squares += h * h;
        fourth += h * h * h * h;
    }
    p.widening = fourth * n / (squares * squares);
    return p;
}

double shareOfTones (const std::vector<std::span<const double>>& stretches)
{
    constexpr std::size_t first = 8;      // a line with fewer periods in a stretch is a drift
    constexpr std::size_t least = 1000;   // lines; in fewer, a resonance may be as narrow as a tone
    double all = 0.0, of_tones = 0.0;
    for (const auto y : stretches)
    {
        const auto powers = linesOf (y.first (fastLength (y.size())));
        if (powers.size() < least) return 0.0;
        double largest = 0.0;
        for (std::size_t j = first; j < powers.size(); ++j)
        {
            all += powers[j];
            if (j > first && j + 1 < powers.size()) largest = std::max (largest, powers[j - 1] + powers[j] + powers[j + 1]);
        }
        of_tones += largest;
    }
    return all > 0.0 ? of_tones / all : 0.0;
}

SpectrumModel fitSpectrum (const Periodogram& data, const std::vector<std::span<const double>>& stretches, int most, const FitCourse* course)
{
    constexpr int patience = 3;   // stops after this many orders without an improvement
    const Turns turns (data, most);
    const auto reflections = reflectionsByBurg (stretches, most);
    double power = 0.0;
    for (const double v : data.power)
        power += v / static_cast<double> (data.power.size());
    const double n = static_cast<double> (data.power.size());

    double least = std::numeric_limits<double>::infinity(), remaining = 1.0;
    int best_order = 0;
    SpectrumModel best;
    for (int order = 1; order <= most && order <= best_order + patience && ! isCancelled (course); ++order)
    {
        const double k = reflections[static_cast<std::size_t> (order) - 1];
        remaining *= 1.0 - k * k;
        const SpectrumSearch search (data, turns, order, course);
        VectorXd x (search.parameters());
        for (int m = 0; m < order; ++m)
            x[m] = 0.5 * math::log ((1.0 + reflections[static_cast<std::size_t> (m)]) / (1.0 - reflections[static_cast<std::size_t> (m)]));
        x[order] = math::log (0.7 * power * remaining);
        x[order + 1] = math::log (0.3 * power * remaining);
        const auto fit = minimise (search.problem(), x);
        const double score = fit.sum() + static_cast<double> (search.parameters()) * math::log (n);
        if (! fit.x.allFinite() || ! (score < least)) continue;
        // Uses the floor itself instead of its logarithm, so that a floor of 0 also widens the other intervals.
        MatrixXd g = search.slopes (fit.x, false);
        g.col (order + 1) *= power;
        const Eigen::SelfAdjointEigenSolver<MatrixXd> information (g.transpose() * g);
        if (! (information.eigenvalues()[0] > 1e-10 * information.eigenvalues().maxCoeff())) continue;
        const VectorXd a = search.coefficients (fit.x);
        least = score;
        best_order = order;
        const MatrixXd inverse = information.eigenvectors() * information.eigenvalues().cwiseInverse().asDiagonal() * information.eigenvectors().transpose();
        best = { { a.begin(), a.end() }, math::exp (fit.x[order]), math::exp (fit.x[order + 1]), fit.sum() / n, data.widening * inverse };
        widenByParts (best.covariance, contributionsOf (stretches, fit.x, order, power, inverse));
        best.covariance.row (order + 1) *= power;
        best.covariance.col (order + 1) *= power;
    }
    return best;
}

}   // namespace tactus::detail
