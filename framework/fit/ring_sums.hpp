// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/at.hpp>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <complex>
#include <numbers>
#include <utility>

/// Sums over the rows of decaying tones e^(rate n).
namespace tactus::detail
{

using Complex = std::complex<double>;
using Eigen::Index;

constexpr Index most_drift = 5;
constexpr double full_turn = 2.0 * std::numbers::pi;

/// Without the tests for infinities of std::complex.
inline Complex times (Complex a, Complex b) { return { a.real() * b.real() - a.imag() * b.imag(), a.real() * b.imag() + a.imag() * b.real() }; }

/// e^(rate n)
Complex powerOf (Complex rate, double n);

/// Sums over rows of (n / rows)^c e^(rate n), for c from 0.
using Sums = std::array<Complex, 2 * most_drift - 1>;

/// The sums from row `begin` to `end`, for c up to `most`. Doubles the number of rows again and again, so nothing cancels.
Sums sumsOf (Complex rate, Index begin, Index end, Index rows, std::size_t most);

/// Calls with the first row of each block of rows, their number, and e^(rate n) of the first row, until the tone has died away.
constexpr Index block = 32;

template <typename Visit>
void visitBlocks (Complex rate, Index begin, Index end, Visit visit)
{
    for (Index n = begin; n < end; n += block)
    {
        if (rate.real() * static_cast<double> (n) < -70.0) return;
        visit (n, std::min (block, end - n), powerOf (rate, static_cast<double> (n)));
    }
}

inline std::array<Complex, block> powersOf (Complex rate)
{
    std::array<Complex, block> powers;
    for (std::size_t i = 0; i < powers.size(); ++i)
        powers[i] = powerOf (rate, static_cast<double> (i));
    return powers;
}

/// Sums over rows of signal e^(rate n), and of signal (n / rows) e^(rate n).
std::pair<Complex, Complex> correlate (const Eigen::VectorXd& signal, Complex rate, Index begin, Index end);

}   // namespace tactus::detail
