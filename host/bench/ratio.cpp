// SPDX-License-Identifier: GPL-3.0-or-later
#include "ratio.hpp"

#include <algorithm>
#include <cmath>

namespace tactus::bench
{

Ratio ratioOf (std::vector<double> rounds)
{
    std::ranges::sort (rounds);
    const auto n = static_cast<double> (rounds.size());
    const auto at = [&] (double rank) { return rounds[static_cast<std::size_t> (std::clamp (rank, 0.0, n - 1.0))]; };

    const double spread = 0.5 * 1.96 * std::sqrt (n);   // half the confidence interval, in rounds
    return { .median = medianOf (rounds), .low = at (std::floor (0.5 * n - spread)), .high = at (std::ceil (0.5 * n + spread) - 1.0) };
}

double medianOf (std::vector<double> values)
{
    const auto middle = values.begin() + static_cast<std::ptrdiff_t> (values.size() / 2);
    std::ranges::nth_element (values, middle);
    return *middle;
}

}   // namespace tactus::bench
