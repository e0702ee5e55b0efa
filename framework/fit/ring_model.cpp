// SPDX-License-Identifier: MIT
#include "ring_model.hpp"
#include "ring_sums.hpp"

#include <tactus/kit/at.hpp>

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace tactus::detail
{

namespace
{
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index per_tone = 4;

/// The functions that the model adds up, without their amplitudes: for each tone Re z, Re i z, Re u z and Re i u z, with z = e^(rate n) and u = n /
/// rows, then the powers of u of the drift.
struct Basis
{
    const std::vector<Complex>& rates;
    Index drift, rows;

    Index tones() const { return static_cast<Index> (rates.size()); }
    Index size() const { return per_tone * tones() + drift; }

    MatrixXd products (Index begin, Index end) const
    {
        MatrixXd all (size(), size());
        for (Index k = 0; k <= tones(); ++k)
            for (Index l = 0; l <= k; ++l)
                setProducts (all, k, l, begin, end);
        return all;
    }

    VectorXd productsWith (const VectorXd& signal, Index begin, Index end) const
    {
        VectorXd all (size());
        for (Index k = 0; k < tones(); ++k)
        {
            const auto [plain, by_row] = correlate (signal, rates[at (k)], begin, end);
            all.segment<4> (per_tone * k) << plain.real(), -plain.imag(), by_row.real(), -by_row.imag();
        }
        VectorXd powers = signal.segment (begin, end - begin);
        const VectorXd u = VectorXd::LinSpaced (end - begin, static_cast<double> (begin), static_cast<double> (end - 1)) / static_cast<double> (rows);
        for (Index c = 0; c < drift; ++c, powers.array() *= u.array())
            all[per_tone * tones() + c] = powers.sum();
        return all;
    }

private:
    struct Term
    {
        Complex weight;
        std::size_t power;
    };

    /// The terms of a tone; those of the drift follow the last tone.
    std::vector<Term> termsOf (Index k) const
    {
        constexpr Complex i { 0.0, 1.0 };
        if (k < tones()) return { { 1.0, 0 }, { i, 0 }, { 1.0, 1 }, { i, 1 } };
        std::vector<Term> terms;
        for (Index c = 0; c < drift; ++c)
            terms.push_back ({ 1.0, at (c) });
        return terms;
    }

    /// Re (v f) Re (w g) = Re (v w f g + v w* f g*) / 2.
    void setProducts (MatrixXd& all, Index k, Index l, Index begin, Index end) const
    {
        const auto first = termsOf (k), second = termsOf (l);
        if (first.empty() || second.empty()) return;
        const auto rateOf = [&] (Index tone) { return tone < tones() ? rates[at (tone)] : Complex {}; };
        const auto most = first.back().power + second.back().power;
        const auto sums = sumsOf (rateOf (k) + rateOf (l), begin, end, rows, most), across = sumsOf (rateOf (k) + std::conj (rateOf (l)), begin, end, rows, most);
        for (std::size_t m = 0; m < first.size(); ++m)
            for (std::size_t n = 0; n < second.size(); ++n)
            {
                const auto v = first[m].weight, w = second[n].weight;
                const auto c = first[m].power + second[n].power;
                const auto i = per_tone * k + static_cast<Index> (m), j = per_tone * l + static_cast<Index> (n);
                all (i, j) = all (j, i) = 0.5 * (times (times (v, w), sums[c]) + times (times (v, std::conj (w)), across[c])).real();
            }
    }
};

/// The slopes of the model as combinations of the basis.
MatrixXd slopesIn (const Basis& basis, const std::vector<DecayingTone>& tones)
{
    MatrixXd slopes = MatrixXd::Zero (basis.size(), basis.size());
    const auto n = static_cast<double> (basis.rows);
    for (Index k = 0; k < basis.tones(); ++k)
    {
        const auto a = tones[at (k)].amplitude;
        slopes.block<4, 4> (per_tone * k, per_tone * k) << 0, 0, 1, 0, 0, 0, 0, 1, -n * a.real(), -n * a.imag(), 0, 0, -n * a.imag(), n * a.real(), 0, 0;
    }
    slopes.bottomRightCorner (basis.drift, basis.drift).setIdentity();
    return slopes;
}

/// The functions of the basis that have amplitudes in the model.
std::vector<Index> linearOf (const Basis& basis)
{
    std::vector<Index> linear;
    for (Index i = 0; i < basis.size(); ++i)
        if (i >= per_tone * basis.tones() || i % per_tone < 2) linear.push_back (i);
    return linear;
}

/// Solves with a symmetric matrix whose diagonal may vary by orders of magnitude.
VectorXd solved (const MatrixXd& matrix, const VectorXd& right)
{
    const VectorXd scale = matrix.diagonal().cwiseMax (1e-300).cwiseSqrt().cwiseInverse();
    const MatrixXd scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
    return scale.asDiagonal() * scaled.ldlt().solve (scale.asDiagonal() * right);
}

/// The best model with these rates, and what its next step needs.
struct Trial
{
    std::vector<Complex> rates;
    RingModel model {};
    MatrixXd normal {};
    VectorXd gradient {};

    Trial (const VectorXd& signal, double squares, std::vector<Complex> r, Index drift) : rates (std::move (r))
    {
        const Index rows = signal.size();
        const Basis basis { rates, drift, rows };
        const MatrixXd products = basis.products (0, rows);
        const VectorXd right = basis.productsWith (signal, 0, rows);
        const auto linear = linearOf (basis);
        const VectorXd amounts = solved (products (linear, linear), right (linear));
        model = { .drift = amounts.tail (drift), .rows = rows, .sum = squares - amounts.dot (right (linear)) };
        for (Index k = 0; k < basis.tones(); ++k)
            model.tones.push_back ({ rates[at (k)], { amounts[2 * k], amounts[2 * k + 1] } });
        const MatrixXd slopes = slopesIn (basis, model.tones);
        normal = slopes.transpose() * products * slopes;
        gradient = slopes.transpose() * (right - products (Eigen::all, linear) * amounts);
    }
};

std::vector<Complex> moved (const std::vector<Complex>& rates, const VectorXd& step, Index rows)
{
    std::vector<Complex> next;
    for (std::size_t k = 0; k < rates.size(); ++k)
    {
        const Index i = per_tone * static_cast<Index> (k);
        const double decay = -rates[k].real(), line = full_turn / static_cast<double> (rows), slowest = 1e-3 / static_cast<double> (rows);
        const double widest = 0.5 * std::max (decay, line);   // a longer step may end in another tone
        const double angle = std::clamp (rates[k].imag() + std::clamp (step[i + 1], -widest, widest), 0.5 * line, 0.999 * std::numbers::pi);
        next.emplace_back (-std::clamp (decay + step[i], std::max (0.3 * decay, slowest), std::max (std::min ({ 3.0 * decay, angle, fastest_decay }), slowest)), angle);
    }
    return next;
}
}   // namespace

std::vector<std::complex<double>> RingModel::allRates() const
{
    std::vector<Complex> rates;
    for (const auto& tone : tones)
        rates.push_back (tone.rate);
    return rates;
}

VectorXd RingModel::values() const
{
    VectorXd all = VectorXd::Zero (rows);
    const VectorXd u = VectorXd::LinSpaced (rows, 0.0, static_cast<double> (rows - 1) / static_cast<double> (rows));
    for (Index c = drift.size(); c-- > 0;)
        all = all.cwiseProduct (u).array() + drift[c];
    for (const auto& tone : tones)
    {
        const auto powers = powersOf (tone.rate);
        visitBlocks (tone.rate, 0, rows, [&] (Index first, Index count, Complex z) {
            const auto a = times (tone.amplitude, z);
            for (Index i = 0; i < count; ++i)
                all[first + i] += a.real() * powers[at (i)].real() - a.imag() * powers[at (i)].imag();
        });
    }
    return all;
}

MatrixXd RingModel::products (Index begin, Index end) const
{
    const auto rates = allRates();
    const Basis basis { rates, drift.size(), rows };
    const MatrixXd slopes = slopesIn (basis, tones);
    return slopes.transpose() * basis.products (begin, end) * slopes;
}

VectorXd RingModel::productsWith (const VectorXd& signal, Index begin, Index end) const
{
    const auto rates = allRates();
    const Basis basis { rates, drift.size(), rows };
    return slopesIn (basis, tones).transpose() * basis.productsWith (signal, begin, end);
}

std::vector<double> RingModel::gains() const
{
    const auto rates = allRates();
    const Basis basis { rates, drift.size(), rows };
    const auto linear = linearOf (basis);
    const MatrixXd products = basis.products (0, rows) (linear, linear);
    std::vector<double> gains;
    for (Index k = 0; k < basis.tones(); ++k)
    {
        const auto a = tones[at (k)].amplitude;
        MatrixXd two = MatrixXd::Zero (products.rows(), 2);
        two (2 * k, 0) = two (2 * k + 1, 1) = 1.0;
        Eigen::Matrix2d inverse;
        for (Index i = 0; i < 2; ++i)
            inverse.col (i) = solved (products, two.col (i)).segment<2> (2 * k);
        const Eigen::Vector2d amounts { a.real(), a.imag() };
        gains.push_back (amounts.dot (inverse.ldlt().solve (amounts)));
    }
    return gains;
}

RingModel fitRing (const VectorXd& signal, const std::vector<Complex>& rates, Index drift, int most_steps, const FitCourse* course)
{
    constexpr double rounding = 1e-11, enough = 1e-6;   // of the sum of squares, and of the mean square of the residuals
    const double squares = signal.squaredNorm();
    Trial best (signal, squares, rates, drift);
    double damping = 1e-3;
    for (int step = 0; step < most_steps && ! rates.empty() && damping < 1e8 && best.model.sum > rounding * squares && ! isCancelled (course); ++step)
    {
        MatrixXd damped = best.normal;
        damped.diagonal() *= 1.0 + damping;
        Trial next (signal, squares, moved (best.rates, solved (damped, best.gradient), signal.size()), drift);
        const double gain = best.model.sum - next.model.sum;
        if (! (gain > 0.0))
        {
            damping *= 10.0;
            continue;
        }
        best = std::move (next);
        damping = std::max (1e-9, 0.1 * damping);
        if (gain < enough * best.model.sum / static_cast<double> (signal.size())) break;
    }
    // Without noise, the sum of squares is lost in its rounding, so the last steps are taken without looking at it.
    const bool is_exact = ! rates.empty() && most_steps > 0 && best.model.sum <= rounding * squares;
    for (int step = 0; is_exact && step < 3; ++step)
        best = Trial (signal, squares, moved (best.rates, solved (best.normal, best.gradient), signal.size()), drift);
    return best.model;
}

}   // namespace tactus::detail
