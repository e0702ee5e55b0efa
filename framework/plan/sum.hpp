// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <limits>

namespace tactus::plan
{

/// The sum of n values. They are added in order of value, so the sum is bit-identical regardless of the order of wires and the
/// names of nodes. Sorts `values` in place.
inline double sum (double* values, int n) noexcept
{
    for (int i = 0; i < n; ++i)
        if (values[i] != values[i]) return std::numeric_limits<double>::quiet_NaN();

    if (n > 2) std::sort (values, values + n);
    double total = n > 0 ? values[0] : 0.0;
    for (int i = 1; i < n; ++i)
        total += values[i];
    return total == total ? total : std::numeric_limits<double>::quiet_NaN();   // inf and -inf always give the same NaN
}

}   // namespace tactus::plan
