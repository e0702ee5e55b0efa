// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"
#include "shock_fit.hpp"

#include <tactus/kit/law.hpp>

#include <vector>

namespace tactus
{

/// A curve of force over depth that follows a recorded indentation, and what the curve leaves out.
struct CurveFit
{
    Law law {};                   ///< a table that never falls and never pulls: the mean of the way in and the way out, or the way in alone
    std::vector<double> in {};    ///< force at the depths of the table on the way in, N; never falls
    std::vector<double> out {};   ///< the same on the way out; empty if the way out was not recorded
    double area = 0.0;            ///< energy that the recorded loop loses, J, and the curve does not; 0 without a way out
    double work = 0.0;            ///< recorded work of the hand on the way in, J
    double residual = 0.0;        ///< root mean square of the recorded forces on the way in minus `in`, and on the way out minus `out`, N
    double drop = 0.0;            ///< the largest fall of the recorded force that the curve flattens, N; 0 if the force never falls with depth
    double falls_from = 0.0;      ///< the recorded force where this fall begins, N
    double peak = 0.0;            ///< largest recorded force, N

    std::vector<double> depth_in {}, force_in {}, depth_out {}, force_out {};   ///< the rows that were used, m and N
    FitReport report {};

    /// True if a hand feels the fall that the curve flattens, so that the curve is not what was recorded.
    bool clicks() const noexcept
    {
        constexpr double felt = 0.05, of_peak = 0.02;   // a hand notices differences of force from about 7 % on
        return drop > felt * falls_from && drop > of_peak * peak;
    }
};

/// Fits a table of force over depth to the contact around the deepest row: straight lines between `points` evenly spaced depths, by least
/// squares on the way in and on the way out, made monotone by pooling neighbours that fall. Because the table is a single curve, the force
/// is the gradient of an energy: a node that plays it is passive, and does not show the recorded hysteresis.
///
/// The rows are in the order of time. Times are not used, so the indentation must be slow. The depth must be 0 at the touch.
/// `points` is from 2 to 1000. If the recorded force falls by more than a hand notices, the verdict is poor. The cross-validation leaves out every
/// fifth of 50 blocks of rows.
///
/// Errors: fit/too_short, fit/not_finite, fit/no_contact, fit/pulls, fit/cancelled. [any thread]
///
/// Source of the monotone fit: the pool-adjacent-violators algorithm, Ayer et al. 1955.
Result<CurveFit> fitCurve (const RecordedLoop&, int points = 20, FitCourse* = nullptr);

}   // namespace tactus
