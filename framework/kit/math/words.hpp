// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cfloat>
#include <cstddef>
#include <cstdint>

/// Elementary functions with the same bits on every machine. They use only operations that IEEE 754 defines exactly: add, subtract,
/// multiply, divide, square root, comparisons and operations on the words of numbers. <math.hpp> lists the functions.
///
/// They choose with select() instead of branches wherever that costs little. Code that uses them must be compiled without contraction into
/// fused multiply-adds.
namespace tactus::math
{

static_assert (FLT_EVAL_METHOD == 0, "intermediate results must be rounded to double, so compile with -msse2 -mfpmath=sse");

inline std::uint64_t wordOf (double x) noexcept { return std::bit_cast<std::uint64_t> (x); }
inline double fromWord (std::uint64_t w) noexcept { return std::bit_cast<double> (w); }

/// Both values are computed, so no jump is needed.
inline double select (bool where, double yes, double no) noexcept { return where ? yes : no; }

inline constexpr std::uint64_t sign_bit = std::uint64_t { 1 } << 63;

inline double magnitude (double x) noexcept { return fromWord (wordOf (x) & ~sign_bit); }

/// The magnitude of x, which must be positive, with the sign of `sign`.
inline double withSign (double x, double sign) noexcept { return fromWord (wordOf (x) | (wordOf (sign) & sign_bit)); }

/// x without its lower 27 bits. The product of two such numbers is exact (Dekker 1971; here cut off instead of rounded).
inline double upperHalf (double x) noexcept { return fromWord (wordOf (x) & ~((std::uint64_t { 1 } << 27) - 1)); }

/// Adding this to a number below 2^51 rounds it to an integer, ties to even, and leaves the integer in the lower bits of the word.
inline constexpr double rounder = 0x1.8p52;

/// 2^n, for n from -1022 to 1023 in two's complement.
inline double powerOfTwo (std::uint64_t n) noexcept { return fromWord ((n + 1023u) << 52); }

}   // namespace tactus::math
