// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cmath>

namespace tactus::host::audio
{

/// How much faster a queue has to be emptied than its rate says, so that as much waits in it as should: what two clocks
/// differ by, learned from the queue.
///
///     e' += (e - e') min (1, w T/r)      e: what waits beyond the aim (s), seen each T
///     x  += w^2 e' T                      the difference of the clocks that is known
///     correction = x + 2 w e'             critically damped
///
/// w falls from 0.15 rad/s to 0.04 rad/s over the first 45 s: quick to find the other clock, then slow to be moved, since
/// e jumps by a tick as ticks and blocks pass each other, and by what either is late, and the pitch should not: 2 ms make 600 ppm
/// at first, and then 160. (A loop over time stamps jumps less,
/// F. Adriaensen, "Using a DLL to filter time", 2005; the tick thread is not asked to read a clock.)
class Servo
{
public:
    /// No two clocks of a computer are farther apart; what asks for more is a fault. Relative.
    static constexpr double most = 0.005;

    void reset() noexcept { *this = {}; }

    /// Keeps what is known of the clocks.
    void restart() noexcept { smooth = 0.0; }

    double operator() (double error_s, double dt_s) noexcept
    {
        elapsed += dt_s;
        const double w = std::clamp (quickest * settled_s / std::max (elapsed, settled_s), slowest, quickest);
        smooth += (error_s - smooth) * std::min (1.0, w * dt_s / smoothing);
        known = std::clamp (known + w * w * smooth * dt_s, -most, most);
        return std::clamp (known + 2.0 * w * smooth, -most, most);
    }

    double difference() const noexcept { return known; }   ///< relative
    double error() const noexcept { return smooth; }       ///< s

private:
    static constexpr double quickest = 0.15, slowest = 0.04;   // rad/s
    static constexpr double settled_s = 12.0;                  // s at the quickest
    static constexpr double smoothing = 0.25;                  // of 1/w

    double elapsed = 0.0, smooth = 0.0, known = 0.0;
};

}   // namespace tactus::host::audio
