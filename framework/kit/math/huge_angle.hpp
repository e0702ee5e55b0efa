// SPDX-License-Identifier: MIT
#pragma once

#include "log.hpp"

#include <array>

namespace tactus::math
{

/// An angle as a number of quarter turns and a remainder of at most an eighth of a turn, y + rest, in rad.
struct ReducedAngle
{
    double y = 0.0, rest = 0.0;
    std::uint64_t quarters = 0;   ///< only the two lowest bits count
};

/// The upper and lower half of a product.
struct WideProduct
{
    WideProduct (std::uint64_t a, std::uint64_t b) noexcept
    {
        constexpr std::uint64_t mask = 0xffffffff;
        const auto low_low = (a & mask) * (b & mask), low_high = (a & mask) * (b >> 32), high_low = (a >> 32) * (b & mask);
        const auto middle = (low_low >> 32) + (low_high & mask) + (high_low & mask);
        high = (a >> 32) * (b >> 32) + (low_high >> 32) + (high_low >> 32) + (middle >> 32);
        low = a * b;
    }

    std::uint64_t high, low;
};

/// 64 bits of 2/pi, beginning with the bit of the weight 2^-first.
inline std::uint64_t bitsOfTwoPerPi (int first) noexcept
{
    static constexpr std::array<std::uint64_t, 20> words { 0xa2f9836e4e441529, 0xfc2757d1f534ddc0, 0xdb6295993c439041, 0xfe5163abdebbc561,
                                                           0xb7246e3a424dd2e0, 0x06492eea09d1921c, 0xfe1deb1cb129a73e, 0xe88235f52ebb4484,
                                                           0xe99c7026b45f7e41, 0x3991d639835339f4, 0x9c845f8bbdf9283b, 0x1ff897ffde05980f,
                                                           0xef2f118b5a0a6d1f, 0x6d367ecf27cb09b7, 0x4f463f669e5fea2d, 0x7527bac7ebe5f17b,
                                                           0x3d0739f78a5292ea, 0x6bfb5fb11f8d5d08, 0x56033046fc7b6bab, 0xf0cfbc209af4361d };
    const int bit = first - 1 + 64, shift = bit % 64;   // 64 zeros come before the first word
    const auto word = [] (int i) { return i > 0 ? words[static_cast<std::size_t> (i - 1)] : 0; };
    const auto upper = word (bit / 64);
    return shift == 0 ? upper : upper << shift | word (bit / 64 + 1) >> (64 - shift);
}

/// Reduces an angle of 2^15 rad or more with integers, so that no digit is lost (Payne & Hanek 1983). Not a number for infinity and NaN.
///
/// With x = m 2^e, those bits of 2/pi that add whole turns to the product are left out, and so are those below 2^-137 quarter turns.
[[gnu::noinline]] inline ReducedAngle reducedHuge (double x) noexcept
{
    if (! (x < infinity)) return { not_a_number, not_a_number, 0 };
    const auto word = wordOf (x);
    const auto m = (word & ((std::uint64_t { 1 } << 52) - 1)) | (std::uint64_t { 1 } << 52);
    const int first = static_cast<int> (word >> 52) - 1075 - 1;

    // m 2/pi 2^e/4, modulo 1, as a fraction with three words
    const WideProduct low (m, bitsOfTwoPerPi (first + 128)), middle (m, bitsOfTwoPerPi (first + 64));
    const auto second = middle.low + low.high;
    const auto top = m * bitsOfTwoPerPi (first) + middle.high + (second < low.high ? 1u : 0u);

    // What remains after the whole quarter turns, from -1/2 to 1/2 of a quarter, as a sign and two words
    auto high = top << 2 | second >> 62, rest = second << 2 | low.low >> 62;
    const bool is_negative = high >> 63 != 0;
    const auto quarters = (top >> 62) + (is_negative ? 1u : 0u);
    if (is_negative)
    {
        high = ~high + (rest == 0 ? 1u : 0u);
        rest = ~rest + 1u;
    }
    const int zeros = high != 0 ? std::countl_zero (high) : 64;   // at most 62, as no double is closer to a multiple of pi/2
    high = zeros == 0 ? high : zeros == 64 ? rest
                                           : high << zeros | rest >> (64 - zeros);
    rest = zeros == 64 ? 0 : rest << zeros;

    // Times pi/2; the first product is exact, as its factors have 30 and 23 bits.
    constexpr double half_pi = 0x1.921fb40000000p+0, half_pi_rest = 0x1.4442d18469899p-24;
    const double scale = powerOfTwo (static_cast<std::uint64_t> (-zeros)) * (is_negative ? -0x1p-64 : 0x1p-64);
    const double a = static_cast<double> (high >> 34) * 0x1p34 * scale;
    const double b = (static_cast<double> (high & 0x3ffffffff) + static_cast<double> (rest >> 11) * 0x1p-53) * scale;
    const auto sum = exactSum (a * half_pi, a * half_pi_rest + b * (half_pi + half_pi_rest));
    return { sum.value, sum.rest, quarters };
}

}   // namespace tactus::math
