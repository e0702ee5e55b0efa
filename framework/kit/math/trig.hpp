// SPDX-License-Identifier: MIT
#pragma once

#include "huge_angle.hpp"

namespace tactus::math
{

/// x = quarters pi/2 + y + rest, with |y| <= pi/4 (and a little for rounding), for x >= 0.
///
/// Up to 2^15 quarter turns, pi/2 is the sum of three numbers, and products with the first two are exact (Cody & Waite 1980). 129 bits
/// of pi/2 suffice: the double below 51471 that is closest to a multiple of pi/2 is 2^-60 away from it.
inline ReducedAngle reduced (double x) noexcept
{
    constexpr double limit = 51471.0, per_half_pi = 0x1.45f306dc9c883p-1;
    constexpr double first = 0x1.921fb54440000p+0, second = 0x1.68c234c4c8000p-39, third = -0x1.9d747f23e32edp-79;
    if (! (x < limit)) return reducedHuge (x);

    const double shifted = x * per_half_pi + rounder, k = shifted - rounder;
    const double coarse = x - k * first, finer = k * second, a = coarse - finer;
    const double finest = k * third - ((coarse - a) - finer), y = a - finest;
    return { y, (a - y) - finest, wordOf (shifted) };
}

/// The sine of y + rest as y + result, for |y| <= pi/4. Error of the polynomial: below 2^-57 of the sine.
inline double sineBeyondLinear (double y, double rest, double z) noexcept
{
    const double z2 = z * z;
    const double a = z * 0x1.111111110f880p-7 - 0x1.5555555555549p-3;
    const double b = z * 0x1.71de357872679p-19 - 0x1.a01a019c12687p-13;
    const double c = z * 0x1.5d932ee5810cep-33 - 0x1.ae5e66d37b052p-26;
    return y * z * (a + z2 * (b + z2 * c)) + (rest - rest * (0.5 * z));
}

/// The cosine of y + rest as a sum of two numbers. Error of the polynomial: below 2^-59.
inline Sum cosineOf (double y, double rest, double z) noexcept
{
    const double z2 = z * z, half = 0.5 * z;
    const double a = 0x1.555555555554bp-5 - z * 0x1.6c16c16c14f91p-10;
    const double b = 0x1.a01a019c844d3p-16 - z * 0x1.27e4f7eac34a4p-22;
    const double c = 0x1.1ee9d7b3f4a94p-29 - z * 0x1.8fa499908b554p-37;
    const double start = 1.0 - half;
    return { start, ((1.0 - start) - half) + (z2 * (a + z2 * (b + z2 * c)) - y * rest) };
}

struct SineCosine
{
    double sine, cosine;
};

/// The sine and the cosine of an angle (rad). Both together cost little more than one. Error below 1 ulp, for all angles.
[[gnu::always_inline]] inline SineCosine sinCos (double x) noexcept
{
    const auto in = reduced (magnitude (x));
    const double z = in.y * in.y, sine = in.y + sineBeyondLinear (in.y, in.rest, z);
    const auto both = cosineOf (in.y, in.rest, z);
    const double cosine = both.value + both.rest;
    const auto is_odd = (in.quarters & 1u) != 0;
    const auto sine_sign = ((in.quarters & 2u) << 62) ^ (wordOf (x) & sign_bit), cosine_sign = ((in.quarters + 1u) & 2u) << 62;
    return { fromWord (wordOf (select (is_odd, cosine, sine)) ^ sine_sign), fromWord (wordOf (select (is_odd, sine, cosine)) ^ cosine_sign) };
}

inline double sin (double x) noexcept
{
    return sinCos (x).sine;
}

inline double cos (double x) noexcept
{
    return sinCos (x).cosine;
}

/// The tangent of an angle (rad): the sine divided by the cosine, both as sums of two numbers. Error below 1.5 ulp, for all angles.
inline double tan (double x) noexcept
{
    const auto in = reduced (magnitude (x));
    const double z = in.y * in.y;
    const auto sine = exactSum (in.y, sineBeyondLinear (in.y, in.rest, z));
    const auto both = cosineOf (in.y, in.rest, z);
    const auto cosine = exactSum (both.value, both.rest);
    const auto is_odd = (in.quarters & 1u) != 0;   // then it is -cosine / sine
    const double n = select (is_odd, cosine.value, sine.value), n_rest = select (is_odd, cosine.rest, sine.rest);
    const double d = select (is_odd, sine.value, cosine.value), d_rest = select (is_odd, sine.rest, cosine.rest);

    const double quotient = n / d;
    const auto sign = ((in.quarters & 1u) << 63) ^ (wordOf (x) & sign_bit);
    return fromWord (wordOf (quotient + (n_rest - quotient * d_rest) / d) ^ sign);
}

}   // namespace tactus::math
