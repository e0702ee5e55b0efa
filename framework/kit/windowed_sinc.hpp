// SPDX-License-Identifier: MIT
#pragma once

#include "math/math.hpp"

#include <cmath>

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

}   // namespace tactus
