// SPDX-License-Identifier: MIT
#pragma once

#include "words.hpp"

namespace tactus::math
{

/// 1/ln 2, and ln 2 as a sum: products of its first part with integers below 2^11 are exact (Cody & Waite 1980).
inline constexpr double per_ln2 = 0x1.71547652b82fep+0, ln2 = 0x1.62e42fefa3800p-1, ln2_rest = 0x1.ef35793c76730p-45;

/// x = k ln 2 + r + rest, with |r| <= ln 2 / 2 (and a little for rounding).
struct HalvedRange
{
    explicit HalvedRange (double x) noexcept
    {
        const double shifted = x * per_ln2 + rounder;
        n = wordOf (shifted) - wordOf (rounder);
        k = shifted - rounder;
        const double coarse = x - k * ln2, fine = k * ln2_rest;
        r = coarse - fine;
        rest = (coarse - r) - fine;
    }

    std::uint64_t n;   // k as an integer
    double k, r, rest;
};

/// exp (r) - 1 - r for |r| <= ln 2 / 2; error below 2^-60. Coefficients: tests/framework/kit/math/coefficients.py.
inline double expBeyondLinear (double r) noexcept
{
    const double r2 = r * r, r4 = r2 * r2;
    const double a = r * 0x1.5555555555556p-5 + 0x1.5555555555556p-3;
    const double b = r * 0x1.6c16c16c15dc9p-10 + 0x1.11111111109b4p-7;
    const double c = r * 0x1.a01a01a934d22p-16 + 0x1.a01a01a7c32c3p-13;
    const double d = r * 0x1.27e4d4d7d0f53p-22 + 0x1.71de0db22c41bp-19;
    const double e = r * 0x1.1f7f2076b3148p-29 + 0x1.af38a07870aacp-26;
    return r2 * 0.5 + r2 * r * ((a + r2 * b) + r4 * ((c + r2 * d) + r4 * e));
}

/// x 2^n for n from -2044 to 2046, also where 2^n is out of range or x 2^n is subnormal: then it is rounded only once.
inline double scaled (double x, std::uint64_t n) noexcept
{
    const auto half = ((n + 4096u) >> 1) - 2048u;
    return x * powerOfTwo (half) * powerOfTwo (n - half);
}

/// e^x. Error below 1.2 ulp.
inline double exp (double x) noexcept
{
    const HalvedRange in { select (x > 710.0, 710.0, select (x < -746.0, -746.0, x)) };   // beyond: infinity and 0
    return scaled (1.0 + (in.r + expBeyondLinear (in.r)), in.n);
}

/// 2^x; exact for integers. Error below 1.2 ulp.
inline double exp2 (double x) noexcept
{
    const double bounded = select (x > 1030.0, 1030.0, select (x < -1080.0, -1080.0, x));   // beyond: infinity and 0
    const double shifted = bounded + rounder, r = (bounded - (shifted - rounder)) * 0x1.62e42fefa39efp-1;
    return scaled (1.0 + (r + expBeyondLinear (r)), wordOf (shifted) - wordOf (rounder));
}

/// e^x - 1, also for the smallest x. Error below 1.2 ulp.
inline double expm1 (double x) noexcept
{
    const HalvedRange in { select (x > 710.0, 710.0, select (x < -50.0, -50.0, x)) };   // beyond: infinity and -1
    const double beyond = expBeyondLinear (in.r) + (in.rest + in.rest * in.r);

    // 2^k - 1 + 2^k r + 2^k beyond. 2^1024 is out of range, so the last factor of two comes at the end.
    const auto is_last = in.k > 1023.0;
    const double k = select (is_last, in.k - 1.0, in.k);
    const double scale = powerOfTwo (wordOf (k + rounder) - wordOf (rounder));
    const double start = scale - 1.0, linear = scale * in.r, sum = start + linear;
    const double lost = linear - (sum - start);   // by rounding the sum; |start| >= |linear|, or start is 0 (Dekker 1971)
    const double result = (sum + (lost + scale * beyond)) * select (is_last, 2.0, 1.0);
    return withSign (magnitude (result), x);   // the sign of 0, too
}

}   // namespace tactus::math
