// SPDX-License-Identifier: MIT
#pragma once

#include "log.hpp"

#include <cmath>
#include <type_traits>

namespace tactus::math
{

/// (atan (t) - t) / t^3 with z = t², for |t| <= tan (pi/8); error below 2^-58 of the angle.
template <typename T>
T arcBeyondLinear (T z) noexcept
{
    const T z2 = z * z, z4 = z2 * z2;
    const T a = z * 0x1.999999999965bp-3 - 0x1.5555555555554p-2;
    const T b = z * 0x1.c71c71b77bbf5p-4 - 0x1.2492492475db5p-3;
    const T c = z * 0x1.3b136eb8af26cp-4 - 0x1.745d14c03c60cp-4;
    const T d = z * 0x1.e1728eb2f7539p-5 - 0x1.110c7a6cae415p-4;
    const T e = z * 0x1.70facd4d6b043p-5 - 0x1.ab80f2b739fdap-5;
    const T f = z * 0x1.f260fd0fba194p-7 - 0x1.125639afdb35fp-5;
    return (a + z2 * b) + z4 * ((c + z2 * d) + z4 * (e + z2 * f));
}

/// The angle of the point (x, y) from the x axis, in rad from -pi to pi. Signs of zeros count, as in C. Error below 1.1 ulp.
///
/// The smaller of |x| and |y| is divided by the larger one. If the angle exceeds pi/8, it is taken from the diagonal, whose tangent is
/// (n - d) / (n + d). The rounding errors of the divisions and sums are added to the result.
template <typename T>
T atan2 (T y, std::type_identity_t<T> x) noexcept
{
    const T size_x = magnitude (x), size_y = magnitude (y);
    const auto is_steep = size_y > size_x;
    T small = select (is_steep, size_x, size_y), large = select (is_steep, size_y, size_x);
    const auto is_infinite = large == infinity;
    small = select (is_infinite, select (small == infinity, all<T> (1.0), all<T> (0.0)), small);
    large = select (is_infinite | (large == 0.0), all<T> (1.0), large);
    const T scale = select (large > 0x1p1000, all<T> (0x1p-600), select (large < 0x1p400, all<T> (0x1p600), all<T> (1.0)));
    small = small * scale;
    large = large * scale;

    const auto is_diagonal = small > large * 0x1.a827999fcef32p-2;   // tan (pi/8)
    const T zero {};
    const T n = select (is_diagonal, small - large, small), n_lost = select (is_diagonal, small - (n + large), zero);
    const T d = select (is_diagonal, large + small, large), d_lost = select (is_diagonal, small - (d - large), zero);
    const T t = n / d, high = upperHalf (t), d_high = upperHalf (d), z = t * t;
    const T low = (((n - high * d_high) - high * (d - d_high)) + (n_lost - t * d_lost)) / d;

    // The angle is eighths pi/4 + sign (high + rest).
    const T rest = t * z * arcBeyondLinear (z) + low;
    const auto is_left = (wordOf (x) & sign_bit) != WordOf<T> {};
    T eighths = select (is_diagonal, all<T> (1.0), zero);
    eighths = select (is_steep, 2.0 - eighths, eighths);
    eighths = select (is_left, 4.0 - eighths, eighths);
    const T sign = select (is_steep, all<T> (-1.0), all<T> (1.0)) * select (is_left, all<T> (-1.0), all<T> (1.0));

    constexpr double eighth = 0x1.921fb54442d18p-1, eighth_rest = 0x1.1a62633145c07p-55;
    const auto sum = exactSum<T> (eighths * eighth, sign * high);
    const T angle = sum.value + (sum.rest + (sign * rest + eighths * eighth_rest));
    return select ((x == x) & (y == y), withSign (magnitude (angle), y), x + y);
}

/// The angle from -pi/2 to pi/2 whose tangent is x. Error below 1.1 ulp.
template <typename T>
T atan (T x) noexcept
{
    return atan2 (x, all<T> (1.0));
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
