// SPDX-License-Identifier: MIT
#pragma once

#include "extended.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

/// The elementary functions of tactus::math for single precision: the same names, with float. They use only operations that IEEE 754
/// defines exactly, so they have the same bits on every machine, and no double. Error at most 3 ulp. [any thread]
namespace tactus::single
{

inline constexpr float infinity = std::numeric_limits<float>::infinity(), not_a_number = std::numeric_limits<float>::quiet_NaN();

inline std::uint32_t wordOf (float x) noexcept { return std::bit_cast<std::uint32_t> (x); }
inline float fromWord (std::uint32_t w) noexcept { return std::bit_cast<float> (w); }
inline float magnitude (float x) noexcept { return fromWord (wordOf (x) & 0x7fffffffu); }

/// The integer closest to x, for |x| below 2^22.
inline float rounded (float x) noexcept { return x + 0x1.8p23f - 0x1.8p23f; }

/// x 2^n, also where 2^n is out of range.
inline float scaled (float x, int n) noexcept
{
    const auto power = [] (int k) { return fromWord (static_cast<std::uint32_t> (k + 127) << 23); };
    const int half = n / 2;
    return x * power (half) * power (n - half);
}

/// exp (r) - 1 for |r| <= ln 2 / 2: the series, whose first term left out is below 2^-26 of it.
inline float expBelow (float r) noexcept
{
    return r + r * r * (0.5f + r * (1.0f / 6.0f + r * (1.0f / 24.0f + r * (1.0f / 120.0f + r * (1.0f / 720.0f + r / 5040.0f)))));
}

inline constexpr float per_ln2 = 0x1.715476p+0f, ln2 = 0x1.62e4p-1f, ln2_rest = 0x1.7f7d1cp-20f;   // ln2 has 15 bits

/// 2^(k + r / ln 2), with k an integer.
inline float powerOf (float k, float r) noexcept { return scaled (1.0f + expBelow (r), static_cast<int> (k)); }

inline float exp (float x) noexcept
{
    if (! (x < 89.0f)) return x == x ? infinity : x;
    if (x < -104.0f) return 0.0f;
    const float k = rounded (x * per_ln2);
    return powerOf (k, (x - k * ln2) - k * ln2_rest);
}

inline float exp2 (float x) noexcept
{
    if (! (x < 129.0f)) return x == x ? infinity : x;
    if (x < -151.0f) return 0.0f;
    const float k = rounded (x);
    return powerOf (k, (x - k) * 0x1.62e430p-1f);
}

inline float expm1 (float x) noexcept
{
    if (! (x < 88.0f)) return x == x ? exp (x) : x;
    if (x < -18.0f) return -1.0f;
    if (magnitude (x) < 0x1p-13f) return x * (1.0f + 0.5f * x);   // keeps the sign of 0
    const float k = rounded (x * per_ln2), power = scaled (1.0f, static_cast<int> (k));
    return power * expBelow ((x - k * ln2) - k * ln2_rest) + (power - 1.0f);
}

/// x = m 2^k with m from sqrt (1/2) to sqrt (2), for positive finite x.
struct Binary
{
    explicit Binary (float x) noexcept
    {
        constexpr std::uint32_t root_half = 0x3f3504f3u;
        const bool is_subnormal = x < 0x1p-126f;
        const auto word = wordOf (is_subnormal ? x * 0x1p24f : x);
        const auto power = static_cast<std::int32_t> (word - root_half) >> 23;
        m = fromWord (word - (static_cast<std::uint32_t> (power) << 23));
        k = static_cast<float> (power - (is_subnormal ? 24 : 0));
    }

    float m, k;
};

/// z P(z) with ln (1 + f) = f - s (f - z P(z)), s = f / (2 + f), z = s²: 2 atanh (s).
inline float logSeries (float z) noexcept { return z * (2.0f / 3.0f + z * (2.0f / 5.0f + z * (2.0f / 7.0f + z * (2.0f / 9.0f + z * (2.0f / 11.0f))))); }

inline float logOf (float x) noexcept
{
    const Binary in { x };
    const float f = in.m - 1.0f, s = f / (2.0f + f);
    return in.k * ln2 + (f - (s * (f - logSeries (s * s)) - in.k * ln2_rest));
}

inline bool isUsual (float x) noexcept { return x > 0.0f && x < infinity; }
inline float logOutside (float x) noexcept { return x == 0.0f ? -infinity : x > 0.0f ? x
                                                                                     : not_a_number; }
inline float log (float x) noexcept { return isUsual (x) ? logOf (x) : logOutside (x); }

inline float log1p (float x) noexcept
{
    const float sum = 1.0f + x;
    if (sum == 1.0f) return x;
    return isUsual (sum) ? logOf (sum) * (x / (sum - 1.0f)) : logOutside (sum);
}

inline constexpr Extended per_ln2_exact = 1.4426950408889634, log10_2 = 0.3010299956639812;

/// The logarithm to base 2 of a positive finite number, to about 2^-30 of its value.
inline Extended preciseLog2 (float x) noexcept
{
    const Binary in { x };
    const Extended f = in.m - 1.0f, s = f / (f + 2.0f);
    const float high = s, z = high * high;
    return in.k + (s * 2.0f + high * logSeries (z)) * per_ln2_exact;
}

inline float log2 (float x) noexcept { return isUsual (x) ? static_cast<float> (preciseLog2 (x)) : logOutside (x); }
inline float log10 (float x) noexcept { return isUsual (x) ? static_cast<float> (preciseLog2 (x) * log10_2) : logOutside (x); }

inline float powOfPositive (float x, float y) noexcept
{
    const Extended power = preciseLog2 (x) * y;
    if (! (power < 129.0f)) return infinity;
    if (power < -151.0f) return 0.0f;
    const float k = rounded (power);
    return powerOf (k, static_cast<float> (power - k) * 0x1.62e430p-1f);
}

/// x^y, by the rules of C (annex F of the standard).
inline float pow (float x, float y) noexcept
{
    if (isUsual (x) && magnitude (y) < infinity) return powOfPositive (x, y);
    if (y == 0.0f || x == 1.0f) return 1.0f;
    if (x != x || y != y) return not_a_number;
    const float size = magnitude (x);
    if (magnitude (y) == infinity)
    {
        if (size == 1.0f) return 1.0f;
        return (size > 1.0f) == (y > 0.0f) ? infinity : 0.0f;
    }
    const bool is_integer = std::trunc (y) == y, is_odd = is_integer && std::trunc (0.5f * y) != 0.5f * y;
    if (x < 0.0f && x > -infinity && ! is_integer) return not_a_number;
    const float sign = std::signbit (x) && is_odd ? -1.0f : 1.0f;
    if (size == 0.0f || size == infinity) return sign * ((size == 0.0f) == (y > 0.0f) ? 0.0f : infinity);
    return sign * powOfPositive (size, y);
}

/// An angle as quarters pi/2 + y, with |y| <= pi/4 (and a little for rounding).
///
/// The angle times 2/pi is computed with integers: 24 bits times the 96 bits of 2/pi that matter at this size (Payne & Hanek 1983).
/// What is left after whole turns has 62 bits after the point, so even close to a multiple of pi/2 it is exact to 2^-25.
struct ReducedAngle
{
    explicit ReducedAngle (Extended x) noexcept
    {
        const float size = magnitude (x);
        y = x;
        if (size >= 0x1.921fb6p-1f) reduce (x, size);
    }

    float y = 0.0f;
    std::uint32_t quarters = 0;   // only the two lowest bits count

private:
    void reduce (Extended x, float size) noexcept
    {
        // One word of zeros, then the bits of 2/pi.
        constexpr std::array<std::uint32_t, 9> bits { 0u, 0xa2f9836eu, 0x4e441529u, 0xfc2757d1u, 0xf534ddc0u,
                                                      0xdb629599u, 0x3c439041u, 0xfe5163abu, 0xdebbc561u };
        if (! (size < infinity))
        {
            y = not_a_number;
            return;
        }
        const auto word = wordOf (size);
        const std::uint64_t mantissa = (word & 0x7fffffu) | 0x800000u;
        const auto first = (word >> 23) - 150u + 30u;   // number of the first bit that matters: higher ones are whole turns
        const auto window = [&bits, place = first / 32, by = first % 32] (std::size_t i) {
            return by == 0 ? bits[place + i] : (bits[place + i] << by) | (bits[place + i + 1] >> (32 - by));
        };
        const auto turns = ((mantissa * window (0)) << 32) + mantissa * window (1) + ((mantissa * window (2)) >> 32);   // in 2^-62 quarter turns
        const auto whole = (turns + (std::uint64_t { 1 } << 61)) >> 62;
        const auto rest = static_cast<float> (static_cast<std::int64_t> (turns - (whole << 62))) * 0x1.921fb6p-62f;
        const bool is_negative = std::signbit (static_cast<float> (x));
        y = (is_negative ? -rest : rest) + x.rest();
        quarters = static_cast<std::uint32_t> (is_negative ? 0u - whole : whole);
    }
};

inline float sineOf (float y) noexcept
{
    const float z = y * y;
    return y + y * z * (-1.0f / 6.0f + z * (1.0f / 120.0f + z * (-1.0f / 5040.0f + z * (1.0f / 362880.0f))));
}

inline float cosineOf (float y) noexcept
{
    const float z = y * y;
    return 1.0f - (0.5f * z - z * z * (1.0f / 24.0f + z * (-1.0f / 720.0f + z * (1.0f / 40320.0f - z / 3628800.0f))));
}

struct SineCosine
{
    float sine, cosine;
};

/// The sine and the cosine of an angle (rad), which may have more digits than a float.
inline SineCosine sinCos (Extended x) noexcept
{
    const ReducedAngle in { x };
    const float sine = sineOf (in.y), cosine = cosineOf (in.y);
    switch (in.quarters & 3u)
    {
    case 0:
        return { sine, cosine };
    case 1:
        return { cosine, -sine };
    case 2:
        return { -sine, -cosine };
    default:
        return { -cosine, sine };
    }
}

inline float sin (Extended x) noexcept { return sinCos (x).sine; }
inline float cos (Extended x) noexcept { return sinCos (x).cosine; }
inline float tan (Extended x) noexcept
{
    const auto both = sinCos (x);
    return both.sine / both.cosine;
}

/// The angle from -pi/8 to pi/8 with this tangent.
inline float arcOf (float t) noexcept
{
    const float z = t * t;
    const float end = 1.0f / 13.0f + z * (-1.0f / 15.0f + z * (1.0f / 17.0f - z / 19.0f));
    return t + t * z * (-1.0f / 3.0f + z * (1.0f / 5.0f + z * (-1.0f / 7.0f + z * (1.0f / 9.0f + z * (-1.0f / 11.0f + z * end)))));
}

/// The angle of the point (x, y) from the x axis, in rad from -pi to pi. Signs of zeros count, as in C.
inline float atan2 (float y, float x) noexcept
{
    if (x != x || y != y) return not_a_number;
    const float size_x = magnitude (x), size_y = magnitude (y);
    const bool is_steep = size_y > size_x;
    float small = is_steep ? size_x : size_y, large = is_steep ? size_y : size_x;
    if (large == infinity)
    {
        small = small == infinity ? 1.0f : 0.0f;
        large = 1.0f;
    }
    if (large == 0.0f) large = 1.0f;
    const float scale = large > 0x1p100f ? 0x1p-60f : large < 0x1p-60f ? 0x1p60f
                                                                       : 1.0f;
    small *= scale;
    large *= scale;

    constexpr float eighth = 0x1.921fb6p-1f, quarter = 0x1.921fb6p+0f, half = 0x1.921fb6p+1f, half_rest = -0x1.777a5cp-24f;
    const bool is_diagonal = small > large * 0x1.a8279ap-2f;   // tan (pi/8)
    float angle = is_diagonal ? eighth + arcOf ((small - large) / (large + small)) : arcOf (small / large);
    if (is_steep) angle = (quarter - angle) + 0.5f * half_rest;
    if (std::signbit (x)) angle = (half - angle) + half_rest;
    return std::copysign (angle, y);
}

inline float atan (float x) noexcept { return atan2 (x, 1.0f); }
inline float otherLeg (float x) noexcept { return std::sqrt ((1.0f - x) * (1.0f + x)); }
inline float asin (float x) noexcept { return atan2 (x, otherLeg (x)); }
inline float acos (float x) noexcept { return atan2 (otherLeg (x), x); }

inline float hypot (float x, float y, float z = 0.0f) noexcept
{
    const float a = magnitude (x), b = magnitude (y), c = magnitude (z), ab = a > b ? a : b, most = ab > c ? ab : c;
    if (a == infinity || b == infinity || c == infinity) return infinity;
    const float scale = most > 0x1p60f ? 0x1p-70f : most < 0x1p-55f ? 0x1p70f
                                                                    : 1.0f,
                u = a * scale, v = b * scale, w = c * scale;
    return std::sqrt ((u * u + v * v) + w * w) / scale;
}

/// The remainder of x / y towards zero, with the sign of x. It is exact.
inline float fmod (float x, float y) noexcept
{
    const float size = magnitude (x), by = magnitude (y);
    if (size < by) return x;
    if (! (size < infinity) || ! (by > 0.0f)) return not_a_number;
    const auto powerOf = [] (float v) { return v < 0x1p-126f ? 1u : wordOf (v) >> 23; };
    const auto integerOf = [] (float v) -> std::uint64_t { return (wordOf (v) & 0x7fffffu) | (v < 0x1p-126f ? 0u : 0x800000u); };
    const auto divisor = integerOf (by);
    auto left = integerOf (size) % divisor;
    for (auto power = powerOf (size) - powerOf (by); power > 0 && left != 0;)
    {
        const auto bits = power < 40u ? power : 40u;
        left = (left << bits) % divisor;
        power -= bits;
    }
    return std::copysign (scaled (static_cast<float> (left), static_cast<int> (powerOf (by)) - 150), x);
}

/// x minus the multiple of y closest to x; if two are equally close, the even one. It is exact.
inline float remainder (float x, float y) noexcept
{
    const float by = magnitude (y), part = fmod (x, 2.0f * by);
    float size = magnitude (part);
    if (! (size > 0.5f * by)) return part;
    size -= by;
    if (size >= 0.5f * by) size -= by;
    return std::signbit (x) ? -size : size;
}

}   // namespace tactus::single
