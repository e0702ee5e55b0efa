// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"
#include "shock_fit.hpp"

#include <tactus/kit/curve.hpp>

#include <vector>

namespace tactus
{

/// The force of a key switch on the way down and back up. Travel starts at 0.
struct SwitchLoop
{
    std::vector<double> travel, press, release;   // travel in m; force of the key in N
};

/// Energy lost by a stroke down and up, in J.
double lostEnergy (const SwitchLoop&);

/// Reduces the number of points: straight lines between them stay within `tolerance` (N) of the recorded force, both on the way
/// down and on the way up (Douglas & Peucker 1973, measured along the force). Travel is rounded to 0.1 um, force to 0.2 mN.
SwitchLoop simplified (const SwitchLoop&, double tolerance);

/// The law of a plane: the mean of the forces on the way down and on the way up. Beyond the last point, it continues as a stop with its steepest
/// slope.
Curve meanOf (const SwitchLoop&);

/// The bound of a bristle that is dragged along the travel: half the difference of the forces.
Curve boundOf (const SwitchLoop&);

/// A passive loop that follows a recorded key.
struct SwitchFit
{
    SwitchLoop recorded {};   ///< both ways at the same positions
    SwitchLoop loop {};       ///< simplified; the way up is nowhere above the way down
    FitReport report {};
};

/// Fits a passive loop to a recording in the order of time: down to the deepest point, and up again. Travel counts from the first row. Readings at
/// the same position are averaged, and negative forces (an offset of the gauge) are set to 0. Where the way up was recorded above the way down, which
/// happens on steep slopes if the meter has backlash, both forces are set to their mean.
///
/// `tolerance`: see simplified. `backlash`: that of the meter (m); on the way up, the key is this much deeper than recorded. The
/// cross-validation leaves out every fifth row.
///
/// Errors: fit/too_short, fit/not_finite, fit/one_way, fit/no_contact, fit/not_released, fit/gains_energy, fit/cancelled. [any thread]
Result<SwitchFit> fitSwitch (const RecordedLoop&, double tolerance, double backlash = 0.0, FitCourse* = nullptr);

}   // namespace tactus
