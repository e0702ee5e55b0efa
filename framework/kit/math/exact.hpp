// SPDX-License-Identifier: MIT
#pragma once

#include "log.hpp"
#include "words.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::math
{

/// The factor that scales numbers up to this size so that their squares neither overflow nor lose digits.
inline double scaleForSquares (double largest) noexcept
{
    return select (largest > 0x1p500, 0x1p-600, select (largest < 0x1p-450, 0x1p600, 1.0));
}

/// sqrt (x² + y²), also of the largest and smallest numbers; infinite if one is infinite. Error below 1.2 ulp.
inline double hypot (double x, double y) noexcept
{
    const double a = magnitude (x), b = magnitude (y);
    const double scale = scaleForSquares (select (b > a, b, a)), u = a * scale, v = b * scale;
    return select ((a == infinity) | (b == infinity), infinity, std::sqrt (u * u + v * v) / scale);
}

/// sqrt (x² + y² + z²), also of the largest and smallest numbers; infinite if one is infinite. Error below 1.4 ulp.
inline double hypot (double x, double y, double z) noexcept
{
    const double a = magnitude (x), b = magnitude (y), c = magnitude (z), most = select (b > a, b, a);
    const double scale = scaleForSquares (select (c > most, c, most)), u = a * scale, v = b * scale, w = c * scale;
    return select ((a == infinity) | (b == infinity) | (c == infinity), infinity, std::sqrt ((u * u + v * v) + w * w) / scale);
}

/// The remainder for |x| >= |y|, or if one is not a number: a division of integers, 11 bits at a time.
[[gnu::noinline]] inline double fmodDivided (double x, double y) noexcept
{
    const double size = magnitude (x), by = magnitude (y);
    if (! (size < infinity) || ! (by > 0.0)) return not_a_number;

    // Each number as an integer below 2^53 and a power of two; subnormal numbers have the same power as the smallest normal ones.
    const auto powerOf = [] (double v) { return std::max<std::uint64_t> (1, wordOf (v) >> 52); };
    const auto integerOf = [] (double v) {
        constexpr std::uint64_t one = std::uint64_t { 1 } << 52;
        return (wordOf (v) & (one - 1)) | (v < 0x1p-1022 ? 0 : one);
    };
    const auto divisor = integerOf (by);
    auto left = integerOf (size) % divisor;
    for (auto power = powerOf (size) - powerOf (by); power > 0 && left != 0;)
    {
        const auto bits = std::min<std::uint64_t> (power, 11);
        left = (left << bits) % divisor;
        power -= bits;
    }

    const double result = scaled (static_cast<double> (left), powerOf (by) - 1075u);   // exact, as it is a multiple of the last bit of y
    return withSign (result, x);
}

/// The remainder of x / y towards zero, with the sign of x. It is exact.
inline double fmod (double x, double y) noexcept { return magnitude (x) < magnitude (y) ? x : fmodDivided (x, y); }

/// x minus the multiple of y closest to x; if two are equally close, the even one. It is exact, and from -|y|/2 to |y|/2.
inline double remainder (double x, double y) noexcept
{
    const double by = magnitude (y);
    const double part = fmod (x, 2.0 * by);                                                     // where 2 y is infinite, x is smaller than that anyway
    const auto half = [by] (double v) { return by < 0x1p-1021 ? v + v - by : v - 0.5 * by; };   // v minus half of y, up to a factor
    double size = magnitude (part);
    if (! (half (size) > 0.0)) return part;
    size -= by;
    if (half (size) >= 0.0) size -= by;
    return fromWord (wordOf (size) ^ (wordOf (x) & sign_bit));
}

}   // namespace tactus::math
