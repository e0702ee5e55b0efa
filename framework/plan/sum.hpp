// SPDX-License-Identifier: MIT
#pragma once

#include <limits>

namespace tactus::plan
{

/// The sum of n values, with the same bits in whatever order they come: they are added in order of value. So a sum
/// does not depend on the order in which wires were drawn, or nodes named. Sorts `values` in place.
inline double sum (double* values, int n) noexcept
{
    if (n == 2) return values[0] + values[1];

    double total = 0.0;
    for (int i = 1; i < n; ++i)
    {
        const double v = values[i];
        int j = i;
        for (; j > 0 && values[j - 1] > v; --j)
            values[j] = values[j - 1];
        values[j] = v;
    }
    if (n > 0) total = values[0];
    for (int i = 1; i < n; ++i)
        total += values[i];
    return total == total ? total : std::numeric_limits<double>::quiet_NaN();
}

}   // namespace tactus::plan
