// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/clips/clip_file.hpp>
#include <tactus/kit/signal/clip_score.hpp>

#include <cmath>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace tactus::fuzz
{

/// Plays a clip in a few places, and writes it. It must be finite, within its peak, and readable again.
inline void tryWholeClip (const Clip& clip)
{
    if (! problemOf (clip).empty()) std::abort();
    if (clipOf (gridOf (clip)).clip.tracks != clip.tracks) std::abort();
    const ClipScore score (clip);
    std::vector<ClipScore::Cursor> cursors (score.size());
    for (const double share : { 0.0, 0.3, 0.31, 0.99, 0.1, 2.0 })
    {
        const auto now = score (share * score.duration(), 1e-4, cursors.data());
        if (! (std::abs (now.value) <= score.peak() + 1e-9) || ! (now.amplitude <= score.peak() + 1e-9) || ! (now.frequency >= 0.0)) std::abort();
    }
    if (clip.events() > 100'000 || score.duration() > 3600.0) return;
    for (const auto* name : { "out.haptic", "out.ahap", "out.hjif", "out.json" })
    {
        const auto written = readers::writeClip (clip, name);
        if (! written) std::abort();
        const auto back = readers::readClip (written->text, name);
        if (! back) std::abort();
        if (std::string_view (name) == "out.json" && back->clip.tracks != clip.tracks) std::abort();
    }
}

}   // namespace tactus::fuzz
