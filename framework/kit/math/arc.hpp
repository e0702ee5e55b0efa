// SPDX-License-Identifier: MIT
#pragma once

#include "log.hpp"

#include <cmath>

namespace tactus::math
{

/// (atan (t) - t) / t^3 with z = t², for |t| <= tan (pi/8); error below 2^-58 of the angle.
inline double arcBeyondLinear (double z) noexcept
{
    const double z2 = z * z, z4 = z2 * z2;
    const double a = z * 0x1.999999999965bp-3 - 0x1.5555555555554p-2;
    const double b = z * 0x1.c71c71b77bbf5p-4 - 0x1.2492492475db5p-3;
    const double c = z * 0x1.3b136eb8af26cp-4 - 0x1.745d14c03c60cp-4;
    const double d = z * 0x1.e1728eb2f7539p-5 - 0x1.110c7a6cae415p-4;
    const double e = z * 0x1.70facd4d6b043p-5 - 0x1.ab80f2b739fdap-5;
    const double f = z * 0x1.f260fd0fba194p-7 - 0x1.125639afdb35fp-5;
    return (a + z2 * b) + z4 * ((c + z2 * d) + z4 * (e + z2 * f));
}

/// The angle of the point (x, y) from the x axis, in rad from -pi to pi. Signs of zeros count, as in C. Error below 1.1 ulp.
///
/// The smaller of |x| and |y| is divided by the larger one. If the angle exceeds pi/8, it is taken from the diagonal, whose tangent is
/// (n - d) / (n + d). The rounding errors of the divisions and sums are added to the result.
inline double atan2 (double y, double x) noexcept
{
    const double size_x = magnitude (x), size_y = magnitude (y);
    const auto is_steep = size_y > size_x;
    double small = select (is_steep, size_x, size_y), large = select (is_steep, size_y, size_x);
    const auto is_infinite = large == infinity;
    small = select (is_infinite, select (small == infinity, 1.0, 0.0), small);
    large = select (is_infinite | (large == 0.0), 1.0, large);
    const double scale = select (large > 0x1p1000, 0x1p-600, select (large < 0x1p400, 0x1p600, 1.0));
    small = small * scale;
    large = large * scale;

    const auto is_diagonal = small > large * 0x1.a827999fcef32p-2;   // tan (pi/8)
    const double n = select (is_diagonal, small - large, small), n_lost = select (is_diagonal, small - (n + large), 0.0);
    const double d = select (is_diagonal, large + small, large), d_lost = select (is_diagonal, small - (d - large), 0.0);
    const double t = n / d, high = upperHalf (t), d_high = upperHalf (d), z = t * t;
    const double low = (((n - high * d_high) - high * (d - d_high)) + (n_lost - t * d_lost)) / d;

    // The angle is eighths pi/4 + sign (high + rest).
    const double rest = t * z * arcBeyondLinear (z) + low;
    const auto is_left = (wordOf (x) & sign_bit) != 0;
    double eighths = select (is_diagonal, 1.0, 0.0);
    eighths = select (is_steep, 2.0 - eighths, eighths);
    eighths = select (is_left, 4.0 - eighths, eighths);
    const double sign = select (is_steep, -1.0, 1.0) * select (is_left, -1.0, 1.0);

    constexpr double eighth = 0x1.921fb54442d18p-1, eighth_rest = 0x1.1a62633145c07p-55;
    const auto sum = exactSum (eighths * eighth, sign * high);
    const double angle = sum.value + (sum.rest + (sign * rest + eighths * eighth_rest));
    return select ((x == x) & (y == y), withSign (magnitude (angle), y), x + y);
}

/// The angle from -pi/2 to pi/2 whose tangent is x. Error below 1.1 ulp.
inline double atan (double x) noexcept
{
    return atan2 (x, 1.0);
}

/// The cosine of the angle with the sine x, and the other way round: sqrt (1 - x²), or not a number beyond -1 and 1.
inline double otherLeg (double x) noexcept
{
    const double size = magnitude (x);
    return std::sqrt (size < 0.5 ? 1.0 - size * size : (1.0 - size) * (1.0 + size));
}

/// The angle from -pi/2 to pi/2 whose sine is x; not a number beyond -1 and 1. Error below 1.6 ulp.
inline double asin (double x) noexcept { return atan2 (x, otherLeg (x)); }

/// The angle from 0 to pi whose cosine is x; not a number beyond -1 and 1. Error below 1.8 ulp.
inline double acos (double x) noexcept { return atan2 (otherLeg (x), x); }

}   // namespace tactus::math
