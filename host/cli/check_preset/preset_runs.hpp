// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/check/measure.hpp>
#include <tactus/text/message.hpp>

#include <filesystem>

namespace tactus::host
{

/// The forces that the simulated devices of a preset let the hand feel, in all its runs.
struct PresetForces
{
    double lasts_s = 0.0;   ///< one run
    int runs = 0;
    double largest = 0.0;   ///< N
    double step = 0.0;      ///< the largest change of a force within 1 ms, in N
    Messages messages {};
};

/// Plays a preset on its simulated devices: as it is, twice, with half of what its guards allow for speed, impulse and energy; and with each knob at
/// each end. The graph must compile, and describe a simulated device for each role. It stops at the first run that shows something wrong, and refuses a
/// preset whose runs have more than `most_ticks` ticks together: a file from a stranger must not run for hours.
///
/// Ids: preset/gesture, preset/stopped, preset/weak, preset/strong, preset/lasting, preset/varies, preset/knob. [main thread]
PresetForces playPreset (const check::Subject&, const std::filesystem::path& folder, double most_ticks);

/// Warns of each condition of docs/check.md that the preset breaks on its own devices, measured in about this many ticks. Id: preset/condition. [main
/// thread]
Messages judgePreset (const check::Subject&, const std::filesystem::path& folder, std::size_t ticks);

}   // namespace tactus::host
