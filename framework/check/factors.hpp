// SPDX-License-Identifier: MIT
#pragma once

namespace tactus::check
{

/// The safety factors of Table 1 in Hayward, "Physically-Based Haptic Synthesis" (2007).
struct Factors
{
    static constexpr double better = 10.0;   ///< the chapter requires at least 2 for alpha and beta, and recommends 10

    double alpha = 2.0;    ///< samples per period in time; 2 is the Nyquist limit
    double beta = 2.0;     ///< position quanta per period in space; 2 is the Nyquist limit
    double gamma = 10.0;   ///< force quanta per amplitude
};

/// The stiffest wall, in N/m, that a device with a damping of B, in N s/m, can render passively: 2B/((2d + 1) T). `period_s` is T,
/// and `delay_ticks` is d, the delay from the sensor to the motor in addition to the hold. Colgate & Schenkel 1994; the chapter,
/// section 1.
constexpr double stiffestWall (double damping, double period_s, double delay_ticks) noexcept
{
    return 2.0 * damping / ((2.0 * delay_ticks + 1.0) * period_s);
}

}   // namespace tactus::check
