// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

namespace tactus
{

/// The height of a surface along a line across its ridges.
struct RecordedProfile
{
    std::vector<double> position {}, height {};   ///< m; positions increase, but need not be evenly spaced
    int most_harmonics = 8;
};

/// Ridges: the height is the sum of amplitude_i sin (2 pi i x / period + phase_i), with i from 1, and x as recorded.
struct GratingFit
{
    struct Harmonic
    {
        int number = 1;
        double amplitude = 0.0, phase = 0.0;   // m, rad
    };

    double period = 0.0;   ///< m
    std::vector<Harmonic> harmonics {};
    FitReport report {};
};

/// Fits period and harmonics, together with the tilt and bow of the sample. BIC selects the number of harmonics. The cross-validation divides
/// the rows into 50 blocks and leaves out every fifth block.
///
/// Errors: fit/too_short, fit/not_finite, fit/position, fit/flat, fit/no_ridges, fit/cancelled. [any thread]
Result<GratingFit> fitGrating (const RecordedProfile&, FitCourse* = nullptr);

}   // namespace tactus
