// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/device/device_numbers.hpp>

#include <algorithm>
#include <cmath>

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

/// The largest virtual damping b, in N s/m, that does not swing by itself on a device with a mass M in kg and a damping of B in N s/m. The node
/// takes the speed from the last two positions, without a delay, and the force is held for a tick. Exact:
///
///     with w = B T/M and a = exp (-w), the loop reaches z = exp (+-j phi) at b = B/((1 - a)/w - a), and z = -1 at b = B/(1 - tanh (w/2)/(w/2))
///
/// While w is small, the first is smaller: 2M/T + 4B/3. The chapter, footnote 2, has 2M/T + B.
inline double largestDamper (double mass, double damping, double period_s) noexcept
{
    const double w = damping * period_s / mass, half = 0.5 * w;
    if (w < 1e-4) return 2.0 * mass / period_s + 4.0 / 3.0 * damping;   // else the differences lose digits
    const double a = std::exp (-w);
    return std::min (damping / ((1.0 - a) / w - a), damping / (1.0 - std::tanh (half) / half));
}

/// The mass that a virtual damper moves in a tick, in kg, for a device whose mass is known: if the first mode of its structure is below half the tick
/// rate, only the mass at the motor.
inline double motorMass (const DeviceNumbers& n, double period_s) noexcept
{
    const double mass = n.mass->value;
    if (! n.first_mode || n.first_mode->value >= 0.5 / period_s) return mass;
    return mass - (n.end_mass ? n.end_mass->value : 0.5 * mass);
}

/// The same for a device whose mass and damping are known.
inline double largestDamper (const DeviceNumbers& n, double period_s) noexcept
{
    return largestDamper (motorMass (n, period_s), n.damping->value, period_s);
}

}   // namespace tactus::check
