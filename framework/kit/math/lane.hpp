// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cfloat>
#include <cstddef>
#include <cstdint>
#include <type_traits>

/// Elementary functions with the same bits on every machine. They use only operations that IEEE 754 defines exactly: add, subtract,
/// multiply, divide, square root, comparisons and operations on the words of numbers. <math.hpp> lists the functions.
///
/// They are templates, and choose with select() instead of branches wherever that costs little. So a type that holds several numbers
/// ("lanes") can take the place of double and gives the same bits in each lane: a vector type of GCC or clang with a specialisation of
/// Word. Code that uses them must be compiled without contraction into fused multiply-adds.
namespace tactus::math
{

static_assert (FLT_EVAL_METHOD == 0, "intermediate results must be rounded to double, so compile with -msse2 -mfpmath=sse");

/// The unsigned type with the same size and lanes as T.
template <typename T>
struct Word;

template <>
struct Word<double>
{
    using type = std::uint64_t;
};

template <typename T>
using WordOf = typename Word<T>::type;

template <typename T>
WordOf<T> wordOf (T x) noexcept
{
    return std::bit_cast<WordOf<T>> (x);
}

template <typename T>
T fromWord (WordOf<T> w) noexcept
{
    return std::bit_cast<T> (w);
}

/// The same number in every lane.
template <typename T>
T all (double x) noexcept
{
    return T {} + x;
}

template <typename T>
concept NotAClass = ! std::is_class_v<T>;

/// Classes have their own function.
template <typename Mask, NotAClass T>
T select (Mask where, T yes, T no) noexcept
{
    return where ? yes : no;
}

template <typename T>
inline constexpr std::size_t lanes = sizeof (T) / sizeof (double);

inline double laneOf (double x, std::size_t) noexcept { return x; }
inline bool isSet (bool mask, std::size_t) noexcept { return mask; }
inline void setLane (double& x, std::size_t, double to) noexcept { x = to; }
inline bool any (bool mask) noexcept { return mask; }

template <typename T>
double laneOf (const T& x, std::size_t i) noexcept
{
    return x[i];
}

template <typename Mask>
bool isSet (const Mask& mask, std::size_t i) noexcept
{
    return mask[i] != 0;
}

template <typename T>
void setLane (T& x, std::size_t i, double to) noexcept
{
    x[i] = to;
}

template <typename Mask>
bool any (const Mask& mask) noexcept
{
    bool found = false;
    for (std::size_t i = 0; i < lanes<Mask>; ++i)
        found = found || mask[i] != 0;
    return found;
}

inline constexpr std::uint64_t sign_bit = std::uint64_t { 1 } << 63;

template <typename T>
T magnitude (T x) noexcept
{
    return fromWord<T> (wordOf (x) & ~sign_bit);
}

/// The magnitude of x, which must be positive, with the sign of `sign`.
template <typename T>
T withSign (T x, T sign) noexcept
{
    return fromWord<T> (wordOf (x) | (wordOf (sign) & sign_bit));
}

/// x without its lower 27 bits. The product of two such numbers is exact (Dekker 1971; here cut off instead of rounded).
template <typename T>
T upperHalf (T x) noexcept
{
    return fromWord<T> (wordOf (x) & ~((std::uint64_t { 1 } << 27) - 1));
}

/// Adding this to a number below 2^51 rounds it to an integer, ties to even, and leaves the integer in the lower bits of the word.
inline constexpr double rounder = 0x1.8p52;

/// 2^n, for n from -1022 to 1023 in two's complement.
template <typename T>
T powerOfTwo (WordOf<T> n) noexcept
{
    return fromWord<T> ((n + 1023u) << 52);
}

}   // namespace tactus::math
