// SPDX-License-Identifier: MIT
#pragma once

#include "log.hpp"

#include <cmath>

namespace tactus::math
{

/// x^y for positive finite x and finite y: exp (y ln x), where y ln x is a sum of two numbers.
inline double powOfPositive (double x, double y) noexcept
{
    const auto ln = preciseLog (x);
    const double product = y * ln.value;
    const double y_high = upperHalf (y), y_low = y - y_high, ln_high = upperHalf (ln.value), ln_low = ln.value - ln_high;
    const double lost = (((y_high * ln_high - product) + y_high * ln_low) + y_low * ln_high) + y_low * ln_low;   // Dekker 1971
    const auto is_usual = magnitude (product) < 1000.0;                                                          // beyond: infinity or 0
    const double rest = select (is_usual, lost + y * ln.rest, 0.0);

    const HalvedRange in { select (is_usual, product, select (product > 0.0, 1000.0, -1000.0)) };
    const auto r = exactSum (in.r, in.rest + rest);
    return scaled (1.0 + (r.value + (expBeyondLinear (r.value) + (r.rest + r.rest * r.value))), in.n);
}

/// x^y if x is not positive and finite, or y is not finite, by the rules of C (annex F of the standard).
[[gnu::noinline]] inline double powOutside (double x, double y) noexcept
{
    if (y == 0.0 || x == 1.0) return 1.0;
    if (x != x || y != y) return not_a_number;
    const double size = magnitude (x);
    if (magnitude (y) == infinity)
    {
        if (size == 1.0) return 1.0;
        return (size > 1.0) == (y > 0.0) ? infinity : 0.0;
    }
    const bool is_integer = std::trunc (y) == y, is_odd = is_integer && std::trunc (0.5 * y) != 0.5 * y;
    if (x < 0.0 && x > -infinity && ! is_integer) return not_a_number;
    const double sign = std::signbit (x) && is_odd ? -1.0 : 1.0;
    if (size == 0.0 || size == infinity) return sign * ((size == 0.0) == (y > 0.0) ? 0.0 : infinity);
    return sign * powOfPositive (size, y);
}

/// x^y. Error below 1.2 ulp.
inline double pow (double x, double y) noexcept
{
    const bool is_usual = (x > 0.0) & (x < infinity) & (magnitude (y) < infinity);
    return is_usual ? powOfPositive (x, y) : powOutside (x, y);
}

}   // namespace tactus::math
