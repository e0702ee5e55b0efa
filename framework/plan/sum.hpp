// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

/// Sums whose bits do not depend on the order of wires and the names of nodes: the values are added in order of value. If one of them is
/// not a number, or if inf meets -inf, the sum is always the same NaN.
///
/// Values that compare as equal are the same bits, or zeros. The order of zeros does not matter: a sum is -0 only if all values are.
namespace tactus::plan
{

/// Replaces every NaN by the same one.
inline double withOneNan (double v) noexcept { return v == v ? v : std::numeric_limits<double>::quiet_NaN(); }

/// Exchanges two values if the second one is smaller. NaN is never exchanged, so none gets lost.
inline void sortTwo (double& a, double& b) noexcept
{
    const double lower = b < a ? b : a, higher = b < a ? a : b;   // without a branch
    a = lower;
    b = higher;
}

/// The sum of up to four values. A fixed network of exchanges sorts them, in a fraction of the instructions of std::sort.
inline double sumOf (double a) noexcept { return withOneNan (a); }
inline double sumOf (double a, double b) noexcept { return withOneNan (a + b); }
inline double sumOf (double a, double b, double c) noexcept
{
    sortTwo (b, c);
    sortTwo (a, c);
    sortTwo (a, b);
    return withOneNan (a + b + c);
}
inline double sumOf (double a, double b, double c, double d) noexcept
{
    sortTwo (a, b);
    sortTwo (c, d);
    sortTwo (a, c);
    sortTwo (b, d);
    sortTwo (b, c);
    return withOneNan (a + b + c + d);
}

inline constexpr int most_in_network = 4;

/// The sum of n values. May sort `values` in place.
inline double sum (double* values, int n) noexcept
{
    switch (n)
    {
    case 0:
        return 0.0;
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
        if (values[i] != values[i]) return std::numeric_limits<double>::quiet_NaN();   // before they are sorted: NaN has no place in an order
    std::sort (values, values + n);
    double total = values[0];
    for (int i = 1; i < n; ++i)
        total += values[i];
    return withOneNan (total);
}

}   // namespace tactus::plan
