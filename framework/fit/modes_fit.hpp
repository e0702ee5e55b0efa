// SPDX-License-Identifier: MIT
#pragma once

#include "fit_report.hpp"

#include <optional>

namespace tactus
{

/// The recorded motion of a struck object after the blow: its acceleration, speed, force or sound, in any unit.
struct RecordedRing
{
    std::vector<double> time {}, value {};   ///< s, evenly spaced, give or take less than half a step
    std::optional<double> from {}, to {};    ///< s; the fitted part. Default: from the largest value to the end, without most of the silence
    std::optional<double> blow {};           ///< s; the time of the blow. Default: the start of the half-wave with the largest value before the fitted part
    int most_modes = 20;
};

/// Decaying tones, sum of amplitude e^(-decay (t - blow)) sin (2 pi frequency (t - start) + phase), with t as recorded.
struct ModesFit
{
    struct Tone
    {
        double frequency = 0.0, decay = 0.0, amplitude = 0.0, phase = 0.0;   // Hz, 1/s, unit of the recording, rad
        double energy = 0.0;                                                 // share of the energy of all modes
    };

    std::vector<Tone> tones {};   ///< by frequency
    double start = 0.0;           ///< s: the start of the fitted part
    double blow = 0.0;            ///< s: the time of the blow, at most `start`
    FitReport report {};
};

/// Fits decaying tones and a slow drift of the sensor. Tones are added one by one: the next one is that which stands out the most from the residual, in
/// spectra weighted with e^(-decay t) for several decays. Then least squares refines all tones together, and removes those that no longer stand out.
/// This ends when no tone stands out more than noise does in one of a thousand recordings. Two tones count as one if their frequencies differ by less
/// than the sum of their decays over 2 pi. The verdict is good only if no tone is left in the residual, and the residual does not decay. The
/// cross-validation divides the rows into 50 blocks and leaves out every fifth block. The time that a fit takes grows with the number of rows n as
/// n log n.
///
/// Errors: fit/too_short, fit/not_finite, fit/time, fit/uneven, fit/silent, fit/blow (a blow after the start of the
/// fitted part, or more than the length of the recording before it), fit/no_ring, fit/cancelled. [any thread]
///
/// Sources: Mamandipoor, Ramasamy & Madhow 2016, Newtonized orthogonal matching pursuit (the search), here with damped tones; Golub & Pereyra 1973,
/// variable projection (the refinement).
Result<ModesFit> fitModes (const RecordedRing&, FitCourse* = nullptr);

}   // namespace tactus
