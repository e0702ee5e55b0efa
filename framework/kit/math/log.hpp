// SPDX-License-Identifier: MIT
#pragma once

#include "exp.hpp"

#include <limits>

namespace tactus::math
{

inline constexpr double infinity = std::numeric_limits<double>::infinity(), not_a_number = std::numeric_limits<double>::quiet_NaN();

/// x = m 2^k with m from sqrt (1/2) to sqrt (2), for positive finite x.
struct Binary
{
    explicit Binary (double x) noexcept
    {
        constexpr std::uint64_t root_half = 0x3fe6a09e667f3bcd, shift = 1100;   // the shift keeps exponents positive
        const auto is_subnormal = x < 0x1p-1022;
        const auto word = wordOf (select (is_subnormal, x * 0x1p54, x));
        const auto shifted = (word - root_half + (shift << 52)) >> 52;
        m = fromWord (word - (shifted << 52) + (shift << 52));
        k = (fromWord (shifted | wordOf (0x1p52)) - (0x1p52 + shift)) - select (is_subnormal, 54.0, 0.0);
    }

    double m, k;
};

/// k ln 2 + ln (1 + f) + rest, for 1 + f from sqrt (1/2) to sqrt (2).
///
/// ln (1 + f) = 2 atanh (s) = 2 s + s z P(z) with s = f / (2 + f) and z = s². It is written f - s (f - z P(z)), as f is exact and the
/// rest is small. Error of P: below 2^-59 of the logarithm.
inline double logOf (double f, double k, double rest) noexcept
{
    const double s = f / (f + 2.0), z = s * s, z2 = z * z;
    const double a = z * 0x1.999999997fdbap-2 + 0x1.5555555555592p-1;
    const double b = z * 0x1.c71c5209628dep-3 + 0x1.24924941f1125p-2;
    const double c = z * 0x1.39a1ba916d84cp-3 + 0x1.74663ee8c5b5ap-3;
    const double p = a + z2 * (b + z2 * (c + z2 * 0x1.2f0565ef26275p-3));
    return k * ln2 + (f - (s * (f - z * p) - (k * ln2_rest + rest)));
}

/// The value of a logarithm where x is not a positive finite number.
inline double logOutside (double x) noexcept
{
    return select (x == 0.0, -infinity, select (x > 0.0, x, not_a_number));
}

/// The natural logarithm. Error below 1.4 ulp.
inline double log (double x) noexcept
{
    const Binary in { x };
    return select ((x > 0.0) & (x < infinity), logOf (in.m - 1.0, in.k, 0.0), logOutside (x));
}

/// ln (1 + x), also for the smallest x. Error below 1.4 ulp.
inline double log1p (double x) noexcept
{
    const double sum = 1.0 + x, back = sum - 1.0;
    const double lost = (1.0 - (sum - back)) + (x - back);   // by rounding the sum (Knuth, TAOCP 2, 4.2.2)
    const Binary in { sum };
    const auto is_near_one = in.k == 0.0;
    const double f = select (is_near_one, x, in.m - 1.0), rest = select (is_near_one, 0.0, lost / sum);
    const double result = select ((sum > 0.0) & (sum < infinity), logOf (f, in.k, rest), logOutside (sum));
    return withSign (magnitude (result), x);   // the sign of 0, too
}

/// A number as a sum of two: `value` is the sum rounded, and `rest` what is missing.
struct Sum
{
    double value, rest;
};

/// a + b, for |a| >= |b| or a = 0.
inline Sum exactSum (double a, double b) noexcept
{
    const double value = a + b;
    return { value, b - (value - a) };
}

/// The natural logarithm of a positive finite number, to about 2^-64 of its value.
///
/// As in logOf, but all that is larger than 2^-64 is kept in two numbers, and products are exact because their factors have at most 26
/// bits (Dekker 1971). The series is 2/3 s (3 + z + z² P(z)): its first two terms are the ones that rounding would spoil. Error of P:
/// below 2^-67.
inline Sum preciseLog (double x) noexcept
{
    const Binary in { x };
    const double f = in.m - 1.0, d = in.m + 1.0, d_high = upperHalf (d), d_low = in.m - (d_high - 1.0), per_d = 1.0 / d;
    const double s = f * per_d, s_high = upperHalf (s);
    const double s_low = ((f - s_high * d_high) - s_high * d_low) * per_d;

    const double z = s * s, z2 = z * z, z_high = s_high * s_high;
    const double a = z * 0x1.b6db6db6dc84ep-2 + 0x1.3333333333330p-1;
    const double b = z * 0x1.1745d225b3219p-2 + 0x1.555555542064fp-2;
    const double c = z * 0x1.99b10f8d72c3dp-3 + 0x1.d89d1416f1e4cp-3;
    const double e = z * 0x1.704c3e700ff3dp-3 + 0x1.66a6a6dd6596cp-3;
    const double more = z2 * ((a + z2 * b) + z2 * z2 * (c + z2 * e)) + s_low * (s_high + s);
    const double series = 3.0 + z_high + more, series_high = upperHalf (series), series_low = more - ((series_high - 3.0) - z_high);

    const double high = s_high * series_high, low = s_low * series_high + s * series_low;
    const double product = upperHalf (high + low), product_low = low - (product - high);
    constexpr double two_thirds = 0x1.5555558000000p-1, two_thirds_rest = -0x1.5555555555555p-28;
    const auto sum = exactSum (in.k * ln2, two_thirds * product);
    return exactSum (sum.value, sum.rest + (in.k * ln2_rest + (two_thirds * product_low + two_thirds_rest * (product + product_low))));
}

/// The natural logarithm times factor + rest; the factor has 26 bits. The result is exact wherever it is an integer.
inline double logTimes (double x, double factor, double rest) noexcept
{
    const auto ln = preciseLog (x);
    const double high = upperHalf (ln.value), low = (ln.value - high) + ln.rest;
    return select ((x > 0.0) & (x < infinity), factor * high + (factor * low + rest * ln.value), logOutside (x));
}

/// The logarithm to base 10; exact for powers of ten. Error below 1 ulp.
inline double log10 (double x) noexcept
{
    return logTimes (x, 0x1.bcb7b18000000p-2, -0x1.6c8d78e6acaa4p-29);
}

/// The logarithm to base 2; exact for powers of two. Error below 1 ulp.
inline double log2 (double x) noexcept
{
    return logTimes (x, 0x1.7154768000000p+0, -0x1.6a3e80f444178p-27);
}

}   // namespace tactus::math
