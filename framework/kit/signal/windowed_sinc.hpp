// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/math/math.hpp>

#include <cmath>
#include <cstddef>

namespace tactus
{

/// sin (x) / x, and 1 at 0.
inline double sinc (double x) noexcept { return x == 0.0 ? 1.0 : math::sin (x) / x; }

/// The modified Bessel function I_0. std::cyl_bessel_i is not available everywhere.
inline double besselI0 (double v) noexcept
{
    double sum = 1.0, term = 1.0;
    for (int k = 1; k < 30; ++k)
        sum += term *= 0.25 * v * v / (k * k);
    return sum;
}

/// A Kaiser window over -1…1 that gives a sinc 60 dB of stopband. Not normalised: divide by its value at 0.
inline double kaiser60 (double r) noexcept
{
    constexpr double beta = 5.65;
    return besselI0 (beta * std::sqrt (1.0 - r * r));
}

/// The value of a table at a place between its entries, from 0 to below the number of the last one, on the straight line between its two
/// neighbours. It has the bits of std::lerp, in half of its instructions: the special cases of std::lerp do not occur here.
inline double betweenEntries (const double* table, double place) noexcept
{
    const auto entry = static_cast<std::ptrdiff_t> (place);   // a signed number converts in one instruction
    const double a = table[entry], b = table[entry + 1], part = place - static_cast<double> (entry);
    if (! (a * b > 0.0)) return std::lerp (a, b, part);
    const double value = a + part * (b - a);
    return b > a ? (b > value ? value : b) : (b < value ? value : b);
}

}   // namespace tactus
