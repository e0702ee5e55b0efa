// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace tactus::bench
{

/// The time of the first function of a pair divided by that of the second, over many rounds.
struct Ratio
{
    double median = 0.0, low = 0.0, high = 0.0;   ///< low to high: the 95 % confidence interval of the median
};

/// Uses order statistics, so it assumes nothing about the distribution. With fewer than six rounds, low and high are the smallest
/// and the largest ratio, which covers less than 95 %.
Ratio ratioOf (std::vector<double> rounds);

double medianOf (std::vector<double> values);

}   // namespace tactus::bench
