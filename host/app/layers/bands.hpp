// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <span>

namespace tactus::host
{

/// The power of a signal in frequency bands of equal width on a log axis. Each value is the mean square within its band.
struct Bands
{
    static constexpr int count = 24;
    static constexpr double lowest_hz = 10.0, highest_hz = 1000.0;   ///< the range that skin can feel

    std::array<double, count> power {};

    static double edge (int) noexcept;   ///< in Hz; edge (0) is the start of the first band
};

/// The bands of some samples. A Hann window is applied so that a loud tone does not leak into all bands. Samples that are not
/// finite count as 0.
Bands bandsOf (std::span<const double> samples, double rate_hz);

}   // namespace tactus::host
