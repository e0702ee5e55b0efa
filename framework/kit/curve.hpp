// SPDX-License-Identifier: MIT
#pragma once

#include "at.hpp"

#include <algorithm>
#include <vector>

namespace tactus
{

/// A curve through points: straight between them, constant beyond the ends. x increases strictly. In files it is
/// [[x…], [y…]]. Reading it allocates nothing. An empty curve is 0 everywhere.
struct Curve
{
    std::vector<double> x, y;

    bool empty() const noexcept { return x.empty(); }
    bool operator== (const Curve&) const = default;

    double operator() (double v) const noexcept
    {
        if (x.empty()) return 0.0;
        if (! (v > x.front())) return y.front();
        if (v >= x.back()) return y.back();

        const auto i = at (std::upper_bound (x.begin(), x.end(), v) - x.begin());
        return y[i - 1] + (y[i] - y[i - 1]) * (v - x[i - 1]) / (x[i] - x[i - 1]);
    }
};

}   // namespace tactus
