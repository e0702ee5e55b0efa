// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

namespace tactus::host
{

/// How much of a signal lies where, in bands as wide as one another on a log axis: each the mean square of what is in it.
struct Bands
{
    static constexpr int count = 24;
    static constexpr double lowest_hz = 10.0, highest_hz = 1000.0;   ///< what skin feels

    std::array<double, count> power {};

    static double edge (int) noexcept;   ///< Hz; 0 is where the first band begins
};

/// Of some samples, through a Hann window, so that a loud tone does not smear over all bands. A sample that is no finite
/// number counts as 0.
Bands bandsOf (std::span<const double> samples, double rate_hz);

}   // namespace tactus::host
