// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/signal/clip_score.hpp>

#include <vector>

namespace tactus::readers
{

/// The value at t, of a line that is held beyond its ends. Where it steps, `before` selects the value before the step.
double heldAt (const std::vector<ClipPoint>& points, double t, bool before, double otherwise);

/// A sounding stretch of a track. It begins after silence or where a phase is set, and ends at the next silence or phase. Formats that restart the phase
/// with each effect or event store a track as such stretches.
struct ClipTone
{
    double from = 0.0, to = 0.0;                         ///< s
    std::vector<ClipPoint> amplitude {}, sharpness {};   ///< at times of the clip; the first is at `from`, the last at `to`
};

std::vector<ClipTone> tonesOf (const ClipTrack&);

/// The phase of a tone, in cycles from 0 to 1.
double cyclesAt (const std::vector<ClipScore::Sweep>&, double time);

}   // namespace tactus::readers
