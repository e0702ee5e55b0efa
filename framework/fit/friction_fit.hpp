// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

#include <tactus/kit/bristle.hpp>

namespace tactus
{

/// A tool that was moved back and forth over a surface. The rows are in order of time.
struct RecordedDrag
{
    std::vector<double> position {};   ///< along the stroke, in m
    std::vector<double> force {};      ///< along the stroke, in N: on the tool (against its movement), or of the hand; the fit detects which
    std::vector<double> load {};       ///< normal force in N; empty: constant, and not recorded
    double assumed_load = 1.0;         ///< N; used if the load was not recorded
};

/// The parameters of friction.elasto_plastic with load `bound`, and a static_ratio of 1.
struct FrictionFit
{
    BristleAdhesion adhesion {};
    double mu = 0.0, d_max = 0.0, break_away = 1.0;
    double reference_load = 1.0;   ///< N: the mean load of the recording
    double offset = 0.0;           ///< zero error of the force sensor, in N
    double first_stretch = 0.0;    ///< of the contact at the first row, in units of d_max
    FitReport report {};

    double stiffness() const noexcept { return mu * reference_load / d_max; }   ///< N/m

    /// The force on the tool along another recording, in N, without the zero error of the sensor.
    std::vector<double> forceAlong (const RecordedDrag&) const;
};

/// Fits mu, d_max, the adhesion function and, for `dupont`, break_away by least squares of the force. Two more unknowns are fitted, but are not
/// part of the friction: the stretch of the contact at the first row and, if the tool slides both ways, the zero offset of the force sensor.
/// For the cross-validation, a fit to the first half predicts the second half. Adhesion functions that fit almost as well as the best one widen
/// the intervals.
///
/// Errors: fit/too_short, fit/not_finite, fit/no_motion, fit/no_load, fit/no_friction, fit/cancelled. [any thread]
Result<FrictionFit> fitFriction (const RecordedDrag&, FitCourse* = nullptr);

}   // namespace tactus
