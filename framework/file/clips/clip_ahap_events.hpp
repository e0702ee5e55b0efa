// SPDX-License-Identifier: MIT
#pragma once

#include "clip_tone.hpp"

#include <optional>
#include <vector>

namespace tactus::readers
{

/// Continuous events of an AHAP, and the two curves that act on all of them: root of the amplitude = intensity times gain, and root of the sharpness =
/// event's sharpness plus shift.
struct AhapEvents
{
    struct Event
    {
        double from, to, intensity, sharpness;
    };
    std::vector<Event> events {};
    std::vector<ClipPoint> gain {}, shift {};   ///< empty if they are 1 and 0 throughout
};

/// The tones of some tracks as events that may sound together. Empty if no common curves exist with which all of them are right within 0.2 %.
std::optional<AhapEvents> ahapEvents (const std::vector<ClipTrack>&);

}   // namespace tactus::readers
