// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/vec3.hpp>

#include <bit>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <limits>

namespace tactus
{

/// A number as the sum of two floats: about 48 bits, for positions and times in single-precision code.
///
/// A float at 0.1 m has steps of 7.5 nm, which at 4 kHz is a speed of 30 um/s. Differences of two nearby numbers of this type are exact to
/// 1e-15 of the numbers, so they may be rounded to float: that happens wherever the result is stored in a float.
///
/// Sums and products are those of Knuth (TAOCP 2, 4.2.2) and Dekker (1971). They need code without contraction into fused multiply-adds.
/// [any thread]
class Extended
{
public:
    constexpr Extended() noexcept = default;
    constexpr Extended (float v) noexcept : high (v) {}
    constexpr Extended (std::integral auto v) noexcept : high (static_cast<float> (v)), low (static_cast<float> (v - static_cast<decltype (v)> (high))) {}

    /// On a processor without a unit for doubles, this is slow at run time; constants cost nothing.
    constexpr Extended (double v) noexcept : high (static_cast<float> (v)), low (static_cast<float> (v - static_cast<double> (high))) {}

    /// The sum of two floats, exactly, if the second one is much smaller.
    static constexpr Extended sumOf (float a, float b) noexcept
    {
        const float sum = a + b;
        return { sum, b - (sum - a), 0 };
    }

    /// `count` steps of an encoder or of a fixed-point number, with at most 31 bits.
    static constexpr Extended steps (std::int32_t count, Extended step) noexcept { return Extended (count) * step; }

    constexpr operator float() const noexcept { return high; }
    constexpr explicit operator double() const noexcept { return static_cast<double> (high) + static_cast<double> (low); }
    constexpr float rest() const noexcept { return low; }   ///< what is missing in the float

    constexpr Extended operator-() const noexcept { return { -high, -low, 0 }; }
    friend constexpr Extended operator+ (Extended a, Extended b) noexcept
    {
        const float sum = a.high + b.high, of_b = sum - a.high;
        return sumOf (sum, ((a.high - (sum - of_b)) + (b.high - of_b)) + (a.low + b.low));
    }
    friend constexpr Extended operator- (Extended a, Extended b) noexcept { return a + -b; }
    friend constexpr Extended operator* (Extended a, Extended b) noexcept
    {
        const Extended p = product (a.high, b.high);
        return sumOf (p.high, p.low + (a.high * b.low + a.low * b.high));
    }
    friend constexpr Extended operator/ (Extended a, Extended b) noexcept
    {
        const float quotient = a.high / b.high;
        return sumOf (quotient, (a - b * Extended (quotient)).high / b.high);
    }
    friend constexpr bool operator== (Extended a, Extended b) noexcept { return a.high == b.high && a.low == b.low; }
    friend constexpr bool operator<(Extended a, Extended b) noexcept { return a.high < b.high || (a.high == b.high && a.low < b.low); }
    friend constexpr bool operator<= (Extended a, Extended b) noexcept { return a.high < b.high || (a.high == b.high && a.low <= b.low); }
    friend constexpr bool operator> (Extended a, Extended b) noexcept { return b < a; }
    friend constexpr bool operator>= (Extended a, Extended b) noexcept { return b <= a; }

    constexpr Extended& operator+= (Extended b) noexcept { return *this = *this + b; }
    constexpr Extended& operator-= (Extended b) noexcept { return *this = *this - b; }
    constexpr Extended& operator*= (Extended b) noexcept { return *this = *this * b; }
    constexpr Extended& operator/= (Extended b) noexcept { return *this = *this / b; }

    /// The product of two floats, exactly.
    static constexpr Extended product (float a, float b) noexcept
    {
        const float p = a * b;
#ifdef __ARM_FEATURE_FMA
        if (! std::is_constant_evaluated()) return { p, __builtin_fmaf (a, b, -p), 0 };   // the same bits in one instruction
#endif
        const float a_high = upper (a), a_low = a - a_high, b_high = upper (b), b_low = b - b_high;
        return { p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low, 0 };
    }

private:
    constexpr Extended (float h, float l, int) noexcept : high (h), low (l) {}

    /// The upper 12 of 24 bits.
    static constexpr float upper (float v) noexcept { return std::bit_cast<float> (std::bit_cast<std::uint32_t> (v) & ~std::uint32_t { 0xfff }); }

    float high = 0.0f, low = 0.0f;
};

template <typename T>
concept PlainNumber = std::is_arithmetic_v<T>;

// Exact matches for numbers of all types. Without them, both conversions, to Extended and to float, would do.
constexpr Extended operator+ (Extended a, PlainNumber auto b) noexcept { return a + Extended (b); }
constexpr Extended operator+ (PlainNumber auto a, Extended b) noexcept { return Extended (a) + b; }
constexpr Extended operator- (Extended a, PlainNumber auto b) noexcept { return a - Extended (b); }
constexpr Extended operator- (PlainNumber auto a, Extended b) noexcept { return Extended (a) - b; }
constexpr Extended operator* (Extended a, PlainNumber auto b) noexcept { return a * Extended (b); }
constexpr Extended operator* (PlainNumber auto a, Extended b) noexcept { return Extended (a) * b; }
constexpr Extended operator/ (Extended a, PlainNumber auto b) noexcept { return a / Extended (b); }
constexpr Extended operator/ (PlainNumber auto a, Extended b) noexcept { return Extended (a) / b; }
constexpr bool operator== (Extended a, PlainNumber auto b) noexcept { return a == Extended (b); }
constexpr bool operator<(Extended a, PlainNumber auto b) noexcept { return a < Extended (b); }
constexpr bool operator<(PlainNumber auto a, Extended b) noexcept { return Extended (a) < b; }
constexpr bool operator<= (Extended a, PlainNumber auto b) noexcept { return a <= Extended (b); }
constexpr bool operator<= (PlainNumber auto a, Extended b) noexcept { return Extended (a) <= b; }
constexpr bool operator> (Extended a, PlainNumber auto b) noexcept { return a > Extended (b); }
constexpr bool operator> (PlainNumber auto a, Extended b) noexcept { return Extended (a) > b; }
constexpr bool operator>= (Extended a, PlainNumber auto b) noexcept { return a >= Extended (b); }
constexpr bool operator>= (PlainNumber auto a, Extended b) noexcept { return Extended (a) >= b; }

inline Extended abs (Extended v) noexcept { return v < 0.0f ? -v : v; }

/// The largest integer that is not above the number.
inline Extended floor (Extended v) noexcept
{
    const float whole = std::floor (static_cast<float> (v));
    return whole == static_cast<float> (v) ? Extended::sumOf (whole, std::floor (v.rest())) : Extended (whole);
}

inline bool isFinite (Extended v) noexcept { return v.rest() - v.rest() == 0.0f && static_cast<float> (v) - static_cast<float> (v) == 0.0f; }
inline Extended finiteOrZero (Extended v) noexcept { return isFinite (v) ? v : Extended(); }

}   // namespace tactus

namespace Eigen
{

template <>
struct NumTraits<tactus::Extended> : GenericNumTraits<tactus::Extended>
{
    using Real = tactus::Extended;
    using NonInteger = tactus::Extended;
    using Nested = tactus::Extended;
    using Literal = tactus::Extended;

    enum
    {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 1,
        ReadCost = 2,
        AddCost = 12,
        MulCost = 20
    };

    static Real epsilon() { return Real (0x1p-47f); }
    static Real dummy_precision() { return Real (0x1p-40f); }
    static int digits10() { return 14; }
};

template <typename Operation>
struct ScalarBinaryOpTraits<tactus::Extended, float, Operation>
{
    using ReturnType = tactus::Extended;
};

template <typename Operation>
struct ScalarBinaryOpTraits<float, tactus::Extended, Operation>
{
    using ReturnType = tactus::Extended;
};

}   // namespace Eigen
