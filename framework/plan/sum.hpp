// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

/// Sums whose bits do not depend on the order of wires and the names of nodes: the values are added in order of value. If one of them is
/// not a number, or if inf meets -inf, the sum is always the same NaN.
///
/// Values that compare as equal have the same bits, or are zeros. The order of zeros does not matter: a sum is -0 only if all values are.
namespace tactus::plan
{

/// Replaces every NaN by the same one.
template <typename T>
T withOneNan (T v) noexcept
{
    // A branch that is never taken costs less than a conditional move, which would have to wait for the sum.
    if (__builtin_expect_with_probability (v == v, 1, 1)) return v;
    return T (std::numeric_limits<double>::quiet_NaN());
}

/// Exchanges two values if the second one is smaller. NaN is never exchanged, so no NaN is lost.
///
/// Compilers turn the comparisons into jumps, and a processor cannot predict them, because which of two forces is larger changes with every
/// motion. The instructions for minimum and maximum give the same bits, also for NaN and for zeros of both signs: the second operand.
template <typename T>
void sortTwo (T& a, T& b) noexcept
{
    const T lower = b < a ? b : a, higher = b < a ? a : b;
    a = lower;
    b = higher;
}

#ifdef __SSE2__
/// One value, kept in the form that these instructions take, from the first exchange to the sum.
struct Lane
{
    Lane (double v) noexcept : value (_mm_set_sd (v)) {}
    Lane (__m128d v) noexcept : value (v) {}

    friend Lane operator+ (Lane a, Lane b) noexcept { return _mm_add_sd (a.value, b.value); }
    friend double withOneNan (Lane v) noexcept { return plan::withOneNan (_mm_cvtsd_f64 (v.value)); }

    __m128d value;   // in the lower half; the upper half means nothing
};

inline void sortTwo (Lane& a, Lane& b) noexcept
{
    const auto lower = _mm_min_sd (b.value, a.value);
    b.value = _mm_max_sd (a.value, b.value);
    a.value = lower;
}

/// Two values that belong to two different sums.
typedef double Two __attribute__ ((vector_size (16)));

inline Two withOneNan (Two v) noexcept
{
    const auto is_number = _mm_cmpord_pd (v, v);
    return _mm_or_pd (_mm_and_pd (is_number, v), _mm_andnot_pd (is_number, _mm_set1_pd (std::numeric_limits<double>::quiet_NaN())));
}

inline void sortTwo (Two& a, Two& b) noexcept
{
    const Two lower = _mm_min_pd (b, a), higher = _mm_max_pd (a, b);
    a = lower;
    b = higher;
}
#endif

/// The sum of up to four values. A fixed network of exchanges sorts them, in a fraction of the instructions of std::sort.
template <typename T>
T sumOf (T a) noexcept
{
    return withOneNan (a);
}
template <typename T>
T sumOf (T a, T b) noexcept
{
    return withOneNan (a + b);
}
template <typename T>
auto sumOf (T a, T b, T c) noexcept
{
    sortTwo (b, c);
    sortTwo (a, c);
    sortTwo (a, b);
    return withOneNan (a + b + c);
}
template <typename T>
auto sumOf (T a, T b, T c, T d) noexcept
{
    sortTwo (a, b);
    sortTwo (c, d);
    sortTwo (a, c);
    sortTwo (b, d);
    sortTwo (b, c);
    return withOneNan (a + b + c + d);
}

#ifdef __SSE2__
inline double sumOf (double a, double b, double c) noexcept
{
    return sumOf<Lane> (a, b, c);
}
inline double sumOf (double a, double b, double c, double d) noexcept { return sumOf<Lane> (a, b, c, d); }
#endif

inline constexpr int most_in_network = 4;

/// The sum of n values. May sort `values` in place.
template <typename T>
T sum (T* values, int n) noexcept
{
    switch (n)
    {
    case 0:
        return T (0.0);
    case 1:
        return sumOf (values[0]);
    case 2:
        return sumOf (values[0], values[1]);
    case 3:
        return sumOf (values[0], values[1], values[2]);
    case most_in_network:
        return sumOf (values[0], values[1], values[2], values[3]);
    default:
        break;
    }
    for (int i = 0; i < n; ++i)
        if (! (values[i] == values[i])) return T (std::numeric_limits<double>::quiet_NaN());   // before sorting, because NaN cannot be ordered
    std::sort (values, values + n);
    T total = values[0];
    for (int i = 1; i < n; ++i)
        total += values[i];
    return withOneNan (total);
}

/// A value of a sum, and which one it is.
struct Placed
{
    double value;
    std::uint32_t term;
};

/// The same sum of n values that are almost in order, as those of moving contacts are if they come in the order of the tick before. Sorts them. A
/// value that has to move far costs as much as sorting all.
inline double sumInOrder (Placed* values, std::size_t n) noexcept
{
    for (std::size_t i = 0; i < n; ++i)
        if (! (values[i].value == values[i].value)) return std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 1, moves_left = 4 * n; i < n; ++i)
    {
        const auto value = values[i];
        auto at = i;
        for (; at > 0 && value.value < values[at - 1].value && moves_left > 0; --at, --moves_left)
            values[at] = values[at - 1];
        values[at] = value;
        if (moves_left > 0) continue;
        std::sort (values, values + n, [] (const Placed& a, const Placed& b) { return a.value < b.value; });
        break;
    }
    double total = values[0].value;
    for (std::size_t i = 1; i < n; ++i)
        total += values[i].value;
    return withOneNan (total);
}

}   // namespace tactus::plan
