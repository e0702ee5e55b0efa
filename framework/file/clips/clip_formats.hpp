// SPDX-License-Identifier: MIT
#pragma once

/// The formats of clip files, one function each. The readers throw ClipProblem.

#include "clip_file.hpp"
#include "clip_json.hpp"
#include "clip_mixing.hpp"

namespace tactus::readers
{

Clip readHaptic (ClipJson&);
Clip readAhap (ClipJson&, const ReadSound&, ClipSounds&);
Clip readHjif (ClipJson&);
Clip readOwnClip (ClipJson&);

ClipText writeHaptic (const Clip&);
ClipText writeAhap (const Clip&);
ClipText writeHjif (const Clip&);
ClipText writeOwnClip (const Clip&);

/// All tracks of a clip as one envelope with transients, as .haptic and AHAP have it. Where tracks sound together, their amplitudes add up,
/// and the sharpness is that of the strongest. A wave becomes its envelope. Says what changed.
ClipTrack oneTrack (const Clip&, Messages& losses);

/// The clip with the envelope of each wave in its place: the largest value of every 10 ms.
Clip withoutWaves (Clip);

inline void lose (Messages& losses, std::string where, std::string what, std::string remedy)
{
    losses.push_back (Message::warning ("clip/not_carried", std::move (where), std::move (what), std::move (remedy)));
}

}   // namespace tactus::readers
