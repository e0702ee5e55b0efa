// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace tactus
{

/// The nearest number of three digits that is not below v, or not above it, so that a reader who follows the text has done enough. `slack`: relative.
inline double roundedBound (double v, bool is_up, double slack = 0.0)
{
    char buffer[32];
    std::snprintf (buffer, sizeof buffer, "%.2e", v);
    const double nearest = std::strtod (buffer, nullptr);
    const auto* exponent = std::strchr (buffer, 'e');
    if (exponent == nullptr || (is_up ? nearest >= v * (1.0 - slack) : nearest <= v * (1.0 + slack))) return nearest;   // also for inf
    double step = 0.01;
    const auto power = std::strtol (exponent + 1, nullptr, 10);
    for (long i = 0; i < std::abs (power); ++i)
        step *= power > 0 ? 10.0 : 0.1;
    return is_up ? nearest + step : nearest - step;
}

}   // namespace tactus
