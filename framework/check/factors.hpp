// SPDX-License-Identifier: MIT
#pragma once

namespace tactus::check
{

/// The safety factors of Table 1 in Hayward, "Physically-Based Haptic Synthesis" (2007).
struct Factors
{
    static constexpr double better = 10.0;   ///< the chapter: at least 2 for alpha and beta, better 10

    double alpha = 2.0;    ///< samples per period in time; 2 is the limit of Nyquist
    double beta = 2.0;     ///< position quanta per period in space; 2 is the limit of Nyquist
    double gamma = 10.0;   ///< force quanta per amplitude
};

/// The stiffest wall that a device with a damping B, in N s/m, can hold, in N/m: 2B/((2d + 1) T). `period_s` is T, and `delay_ticks` is
/// d, the delay from the sensor to the motor in addition to the hold. Colgate & Schenkel 1994; the chapter, section 1.
constexpr double stiffestWall (double damping, double period_s, double delay_ticks) noexcept
{
    return 2.0 * damping / ((2.0 * delay_ticks + 1.0) * period_s);
}

}   // namespace tactus::check
