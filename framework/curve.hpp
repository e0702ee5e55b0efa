// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace tactus
{

/// A curve through points, straight between them, held beyond the ends. x increases strictly; in files
/// [[x…], [y…]]. Reading a curve allocates nothing; an empty curve is 0 everywhere.
struct Curve
{
    std::vector<double> x, y;

    bool empty() const noexcept { return x.empty(); }
    bool operator== (const Curve&) const = default;

    double operator() (double at) const noexcept
    {
        if (x.empty()) return 0.0;
        if (! (at > x.front())) return y.front();
        if (at >= x.back()) return y.back();

        const auto i = static_cast<std::size_t> (std::upper_bound (x.begin(), x.end(), at) - x.begin());
        return y[i - 1] + (y[i] - y[i - 1]) * (at - x[i - 1]) / (x[i] - x[i - 1]);
    }
};

}   // namespace tactus
