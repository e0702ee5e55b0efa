// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

#include <tactus/kit/law.hpp>

namespace tactus
{

/// A blade that was pressed into a sample. The rows are in order of time; the blade may be pulled out and pressed in again.
struct RecordedCut
{
    std::vector<double> depth {}, force {};   ///< m, below the surface of the sample; N, against the blade
    double width = 0.02;                      ///< m: length of the edge inside the sample
};

/// The parameters of cut.blade, without a thickness.
struct BladeFit
{
    Law law {}, cracked_law {};   ///< powers; cracked_law is of kind `none` if it is the same as law
    double toughness = 0.0;       ///< J/m2
    double rupture_force = 0.0;   ///< N
    double width = 0.0;           ///< m
    bool bursts = false;          ///< false: the sample did not burst, so toughness and rupture_force are guesses
    FitReport report {};
};

/// Fits the stiffness before and after the burst, the force at the burst and the toughness. The crack right after the burst follows from the
/// energy that the sample had stored (Griffith), as in the node. The burst is a jump between two rows, so the interval
/// of its force is the narrower of two: that of the fit, and that between the two rows. A recording that ends before the burst gives only
/// lower bounds for the two forces, and one that ends before the blade cuts on gives only a lower bound for the toughness. The cross-validation
/// divides the rows into 50 blocks and leaves out every fifth block.
///
/// Errors: fit/too_short, fit/not_finite, fit/no_contact, fit/pulls, fit/no_cut, fit/cancelled. [any thread]
Result<BladeFit> fitBlade (const RecordedCut&, FitCourse* = nullptr);

}   // namespace tactus
