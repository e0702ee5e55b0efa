// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace tactus::bench
{

/// How many times as much one takes as another, over many rounds.
struct Ratio
{
    double median = 0.0, low = 0.0, high = 0.0;   ///< low to high: where the true median is, with 95 % certainty
};

/// By order statistics, so nothing is asked of the distribution. With fewer than six rounds the smallest and the largest,
/// which is less than 95 %.
Ratio ratioOf (std::vector<double> rounds);

double medianOf (std::vector<double> values);

}   // namespace tactus::bench
