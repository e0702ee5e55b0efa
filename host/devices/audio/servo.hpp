// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

namespace tactus::host::audio
{

/// Estimates how much faster than its nominal rate a queue must be emptied to hold its target level. This is the difference
/// between two clocks, learned from the level of the queue.
///
///     e' += (e - e') min (1, w T/r)      e: level above the target (s), measured every T
///     x  += w^2 e' T                      the learned difference between the clocks
///     correction = x + 2 w e'             critically damped
///
/// w falls from 0.15 rad/s to 0.04 rad/s over the first 45 s: it finds the other clock quickly, then reacts slowly. The
/// level e jumps by a tick as ticks and blocks pass each other, and further if one of them is late, but the pitch should not
/// follow: a jump of 2 ms changes it by 600 ppm at first, and later by 160 ppm. (A loop over time stamps jumps less:
/// F. Adriaensen, "Using a DLL to filter time", 2005. But it would need the tick thread to read a clock.)
class Servo
{
public:
    /// The largest correction, relative. No two clocks of a computer differ by more, so a larger correction is a fault.
    static constexpr double most = 0.005;

    void reset() noexcept { *this = {}; }

    /// Forgets the level, but keeps the learned clock difference.
    void restart() noexcept { smooth = 0.0; }

    double operator() (double error_s, double dt_s) noexcept
    {
        elapsed += dt_s;
        const double w = std::clamp (quickest * settled_s / std::max (elapsed, settled_s), slowest, quickest);
        smooth += (error_s - smooth) * std::min (1.0, w * dt_s / smoothing);
        known = std::clamp (known + w * w * smooth * dt_s, -most, most);
        return std::clamp (known + 2.0 * w * smooth, -most, most);
    }

    double difference() const noexcept { return known; }   ///< learned difference between the clocks, relative
    double error() const noexcept { return smooth; }       ///< smoothed deviation from the target level, in s

private:
    static constexpr double quickest = 0.15, slowest = 0.04;   // rad/s
    static constexpr double settled_s = 12.0;                  // how long w stays at `quickest`, in s
    static constexpr double smoothing = 0.25;                  // r: the time constant of e', as a fraction of 1/w

    double elapsed = 0.0, smooth = 0.0, known = 0.0;
};

}   // namespace tactus::host::audio
