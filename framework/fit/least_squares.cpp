// SPDX-License-Identifier: MIT
#include "least_squares.hpp"

#include <tactus/kit/math/math.hpp>

#include <Eigen/Eigenvalues>
#include <unsupported/Eigen/NonLinearOptimization>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

namespace tactus::detail
{

namespace
{
/// The interface that Eigen's optimiser needs.
struct Functor
{
    using Scalar = double;
    using InputType = Eigen::VectorXd;
    using ValueType = Eigen::VectorXd;
    using JacobianType = Eigen::MatrixXd;
    enum
    {
        InputsAtCompileTime = Eigen::Dynamic,
        ValuesAtCompileTime = Eigen::Dynamic
    };

    const LeastSquares& problem;
    Eigen::Index parameters;

    Eigen::Index inputs() const { return parameters; }
    Eigen::Index values() const { return problem.rows; }

    int operator() (const Eigen::VectorXd& x, Eigen::VectorXd& residual) const
    {
        problem.residual (x, residual);
        return isCancelled (problem.course) ? -1 : 0;
    }

    int df (const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) const
    {
        if (problem.jacobian)
        {
            problem.jacobian (x, jacobian);
            return 0;
        }
        Eigen::VectorXd moved = x, above (problem.rows), below (problem.rows);
        for (Eigen::Index i = 0; i < parameters; ++i)
        {
            moved[i] = x[i] + problem.step;
            problem.residual (moved, above);
            moved[i] = x[i] - problem.step;
            problem.residual (moved, below);
            moved[i] = x[i];
            jacobian.col (i) = (above - below) / (2.0 * problem.step);
        }
        return isCancelled (problem.course) ? -1 : 0;
    }
};

constexpr double finest = 1e-6;   // error of a sensor over the size of the signal

/// An autoregressive model of residuals.
struct Dependence
{
    std::vector<double> a;   // r_n = sum_k a_k r_(n-k) + e_n
    double variance = 1.0;   // of e, relative to that of r
};

/// Burg's method, with the order that BIC selects. Stable by construction.
Dependence dependenceOf (const Eigen::VectorXd& r)
{
    const auto n = r.size();
    const Eigen::Index most = std::min<Eigen::Index> (20, n / 20);
    Eigen::VectorXd forward = r, backward = r;
    std::vector<double> a;
    double variance = 1.0, least = 0.0;
    Dependence best;
    for (Eigen::Index m = 1; m <= most; ++m)
    {
        const auto f = forward.tail (n - m), b = backward.segment (m - 1, n - m);
        const double power = f.squaredNorm() + b.squaredNorm();
        if (! (power > 0.0)) break;
        const double k = 2.0 * f.dot (b) / power;
        const Eigen::VectorXd next_f = f - k * b, next_b = b - k * f;
        forward.tail (n - m) = next_f;
        backward.segment (m, n - m) = next_b;
        const auto before = a;
        for (std::size_t j = 0; j < before.size(); ++j)
            a[j] = before[j] - k * before[before.size() - 1 - j];
        a.push_back (k);
        variance *= std::max (1e-12, 1.0 - k * k);
        const double bic = static_cast<double> (n) * math::log (variance) + static_cast<double> (m) * math::log (static_cast<double> (n));
        if (bic >= least) continue;
        least = bic;
        best = { a, variance };
    }
    return best;
}
}   // namespace

LeastSquaresFit evaluated (const LeastSquares& problem, const Eigen::VectorXd& x)
{
    LeastSquaresFit fit { .x = x, .residual = Eigen::VectorXd (problem.rows), .jacobian = Eigen::MatrixXd (problem.rows, x.size()), .size = problem.size };
    problem.residual (x, fit.residual);
    Functor { problem, x.size() }.df (x, fit.jacobian);
    return fit;
}

LeastSquaresFit minimise (const LeastSquares& problem, Eigen::VectorXd x)
{
    Functor functor { problem, x.size() };
    Eigen::LevenbergMarquardt<Functor> search (functor);
    search.parameters.maxfev = 400;
    search.parameters.ftol = search.parameters.xtol = 1e-9;
    search.minimize (x);
    return evaluated (problem, x);
}

Eigen::MatrixXd influenceOf (const LeastSquaresFit& fit)
{
    // The residual is recorded minus model, so its slope is minus that of the model.
    constexpr double none = 1e-10;
    Eigen::VectorXd scale = fit.jacobian.colwise().norm();
    for (double& s : scale)
        s = s > 0.0 ? 1.0 / s : 0.0;
    const Eigen::MatrixXd scaled = fit.jacobian * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> normal (scaled.transpose() * scaled);
    Eigen::VectorXd inverse = normal.eigenvalues();
    for (double& v : inverse)
        v = v > none ? 1.0 / v : 0.0;
    return -(scale.asDiagonal() * (normal.eigenvectors() * inverse.asDiagonal() * normal.eigenvectors().transpose())) * scaled.transpose();
}

std::vector<bool> isSet (const LeastSquaresFit& fit)
{
    constexpr double none = 1e-8, part = 1e-2;
    const auto p = fit.jacobian.cols();
    Eigen::VectorXd scale = fit.jacobian.colwise().norm();
    std::vector<bool> set (static_cast<std::size_t> (p));
    for (Eigen::Index i = 0; i < p; ++i)
        set[static_cast<std::size_t> (i)] = scale[i] > 1e-12 * scale.maxCoeff();
    for (double& s : scale)
        s = s > 0.0 ? 1.0 / s : 0.0;
    const Eigen::MatrixXd scaled = fit.jacobian * scale.asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> normal (scaled.transpose() * scaled);
    for (Eigen::Index k = 0; k < p; ++k)
        if (normal.eigenvalues()[k] <= none)
            for (Eigen::Index i = 0; i < p; ++i)
                if (std::abs (normal.eigenvectors() (i, k)) > part) set[static_cast<std::size_t> (i)] = false;
    return set;
}

namespace
{
/// The variance of the independent errors behind the residuals.
double innovationOf (const Eigen::VectorXd& residual, const Dependence& dependence, Eigen::Index parameters)
{
    const double independent = independentRows (residual), taken = std::min (static_cast<double> (parameters), 0.8 * independent);
    return residual.squaredNorm() / static_cast<double> (residual.size()) * independent / (independent - taken) * dependence.variance;
}

/// Independent errors e pass an all-pole filter and become the residuals r. So the influence of e on an estimate is the influence of r, filtered
/// backwards in time. Each fitted parameter takes up the error of one independent row. If rows depend on one another, several of them count as
/// one independent row.
Eigen::MatrixXd covarianceOfRows (const Eigen::MatrixXd& influence, const Eigen::VectorXd& residual, Eigen::Index parameters)
{
    const auto n = residual.size(), p = influence.rows();
    const auto dependence = dependenceOf (residual);
    const double variance = innovationOf (residual, dependence, parameters);
    if (dependence.a.empty()) return variance * influence * influence.transpose();

    // The response of the filter extends to before the first row.
    const Eigen::Index before = std::min<Eigen::Index> (n, 2000);
    Eigen::MatrixXd filtered = Eigen::MatrixXd::Zero (p, n + before);
    for (Eigen::Index s = n + before; s-- > 0;)
    {
        if (s >= before) filtered.col (s) = influence.col (s - before);
        for (std::size_t k = 0; k < dependence.a.size(); ++k)
            if (const auto later = s + 1 + static_cast<Eigen::Index> (k); later < n + before) filtered.col (s) += dependence.a[k] * filtered.col (later);
    }
    return variance * filtered * filtered.transpose();
}
}   // namespace

void widenByParts (Eigen::MatrixXd& covariance, const Eigen::MatrixXd& of_quarters)
{
    Eigen::VectorXd factor = Eigen::VectorXd::Ones (covariance.rows());
    const auto disagree = [&] (const Eigen::MatrixXd& parts) {
        const auto count = static_cast<double> (parts.cols());
        const Eigen::VectorXd variance = (parts.colwise() - parts.rowwise().mean()).rowwise().squaredNorm() * count / (count - 1.0);
        for (Eigen::Index i = 0; i < factor.size(); ++i)
            if (covariance (i, i) > 0.0 && std::isfinite (variance[i])) factor[i] = std::max (factor[i], std::sqrt (variance[i] / covariance (i, i)));
    };
    disagree (of_quarters);
    Eigen::MatrixXd halves (of_quarters.rows(), 2);
    halves << of_quarters.leftCols (quarters / 2).rowwise().sum(), of_quarters.rightCols (quarters / 2).rowwise().sum();
    disagree (halves);
    covariance = (factor.asDiagonal() * covariance * factor.asDiagonal()).eval();
}

Eigen::MatrixXd covarianceOf (const Eigen::MatrixXd& influence, const Eigen::VectorXd& residual, Eigen::Index parameters, double size)
{
    if (residual.squaredNorm() <= static_cast<double> (residual.size()) * finest * finest * size * size)
        return finest * finest * size * size * influence * influence.transpose();
    Eigen::MatrixXd covariance = covarianceOfRows (influence, residual, parameters);
    const auto n = residual.size();
    Eigen::MatrixXd of_quarters (influence.rows(), quarters);
    for (Eigen::Index q = 0; q < quarters; ++q)
    {
        const auto from = n * q / quarters, count = n * (q + 1) / quarters - from;
        of_quarters.col (q) = influence.middleCols (from, count) * residual.segment (from, count);
    }
    widenByParts (covariance, of_quarters);
    return covariance;
}

Eigen::MatrixXd covarianceOf (const LeastSquaresFit& fit)
{
    Eigen::MatrixXd covariance = covarianceOf (influenceOf (fit), fit.residual, fit.x.size(), fit.size);
    const auto set = isSet (fit);
    for (Eigen::Index i = 0; i < fit.x.size(); ++i)
    {
        if (set[static_cast<std::size_t> (i)]) continue;
        covariance.row (i).setZero();
        covariance.col (i).setZero();
        covariance (i, i) = std::numeric_limits<double>::infinity();
    }
    return covariance;
}

double varianceAlong (const Eigen::MatrixXd& covariance, Eigen::Index first, const Eigen::VectorXd& factors)
{
    const auto n = factors.size();
    const Eigen::MatrixXd block = covariance.block (first, first, n, n);
    if (! block.allFinite()) return std::numeric_limits<double>::infinity();
    return std::max (0.0, factors.dot (block * factors));
}

double independentRows (const Eigen::VectorXd& residual)
{
    const auto dependence = dependenceOf (residual);
    double gain = 1.0;   // of the all-pole filter at frequency 0
    for (const double a : dependence.a)
        gain -= a;
    return static_cast<double> (residual.size()) * std::min (1.0, gain * gain / dependence.variance);
}

Eigen::VectorXd errorPowers (const Eigen::VectorXd& residual, const Eigen::VectorXd& angles, double size)
{
    const auto dependence = dependenceOf (residual);
    const double variance = innovationOf (residual, dependence, angles.size());
    Eigen::VectorXd powers (angles.size());
    for (Eigen::Index i = 0; i < angles.size(); ++i)
    {
        std::complex<double> gain = 1.0;
        for (std::size_t k = 0; k < dependence.a.size(); ++k)
        {
            const auto [sine, cosine] = math::sinCos (angles[i] * static_cast<double> (k + 1));
            gain -= dependence.a[k] * std::complex<double> { cosine, -sine };
        }
        powers[i] = std::max (variance / std::norm (gain), finest * finest * size * size);
    }
    return powers;
}

double halfWidth95 (double freedom)
{
    const double n = std::max (1.0, freedom);
    // The asymptotic series of Student's t; the last term makes it exact at 1 degree of freedom.
    return 1.959964 + (2.3723 + (2.8225 + (2.5556 + (1.5895 + 1.4063 / n) / n) / n) / n) / n;
}

FitValue withInterval (std::string name, std::string unit, double value, double deviation, double freedom, bool is_main)
{
    const double half = halfWidth95 (freedom) * deviation;
    return { std::move (name), std::move (unit), value, value - half, value + half, is_main };
}

FitValue withLogInterval (std::string name, std::string unit, double value, double log_deviation, double freedom, bool is_main)
{
    const double factor = math::exp (halfWidth95 (freedom) * log_deviation);
    return { std::move (name), std::move (unit), value, value / factor, value * factor, is_main };
}

}   // namespace tactus::detail
