// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

#include <tactus/kit/law.hpp>

#include <vector>

namespace tactus
{

/// A recorded impact or indentation: depth and force on the way in and out. The rows are in order of time.
struct RecordedLoop
{
    std::vector<double> depth;     ///< in m, > 0 inside the object
    std::vector<double> force;     ///< in N, > 0 out of the object
    std::vector<double> time {};   ///< in s, rising; empty: not recorded
};

/// A spring and a damper that dissipate as much energy along the recorded path as the recorded object did.
struct ShockFit
{
    Law stiffness;                                 ///< K = k d^n
    Law damping;                                   ///< {"dissipation": lambda}: D = lambda K; or {"power": [B0, 1]}: D = B0 d
    double mass = 0.0;                             ///< mass that rebounded, in kg: as given, or estimated from the times
    double speed = 0.0;                            ///< at the touch, on the way in, in m/s
    double speed_error = 0.0;                      ///< its standard deviation by noise of the depth; 0 without times
    double recorded_area = 0.0;                    ///< of the recorded loop, in J
    double fitted_area = 0.0;                      ///< of the fitted force over the recorded path, in J; equal to recorded_area
    double played_area = 0.0;                      ///< of a free impact of the mass at this speed, m v^2 (1 - e^2) / 2, in J
    double residual = 0.0;                         ///< root mean square of recorded minus fitted force, in N
    double peak = 0.0;                             ///< largest recorded force, in N
    std::vector<double> depth, recorded, fitted;   ///< the rows that were used, in m and N
    FitReport report {};
};

/// Fits N = max (0, K + D d'), K = k d^n, to the contact around the deepest row: by least squares among all laws whose loop has the recorded
/// area. n is from 0.5 to 4. D is lambda K, as in Hunt & Crossley, or B0 d, as in the chapter's example, if that fits clearly better.
///
/// If the recording has times, d' comes from them, and the recording may follow any path. Without times, it must be a free impact:
/// d' then follows from the energy that the mass has lost so far, v^2 = 2 (W_deepest - W) / m. `mass` is in kg. If it is 0, the
/// mass is computed from the times, as impulse over change of speed; this, too, requires a free impact.
///
/// The intervals take the recorded area into account, and include only errors of the force; that of the mass also includes those of the depth. The
/// cross-validation divides the rows into 50 blocks and leaves out every fifth block.
///
/// Errors: fit/too_short, fit/not_finite, fit/time, fit/no_contact, fit/no_loop, fit/gains_energy, fit/mass, fit/no_spring,
/// fit/cancelled. [any thread]
///
/// Source: Hayward, "Physically-Based Haptic Synthesis" (2007), section 6: the area of the loop of force against deflection matters
/// more than its shape. The law is eq. (10).
Result<ShockFit> fitShock (const RecordedLoop&, double mass = 0.0, FitCourse* = nullptr);

}   // namespace tactus
