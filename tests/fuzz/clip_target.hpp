// SPDX-License-Identifier: MIT
#pragma once

#include "whole_error.hpp"

#include <tactus/file/clips/clip_file.hpp>
#include <tactus/kit/clip_score.hpp>

#include <cmath>
#include <string>
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

/// Reads the text as each kind of clip and as a calibration. Either it is a whole clip, or reading reports an error with its location.
/// Aborts otherwise.
inline void tryClip (std::string_view text)
{
    for (const auto* name : { "fuzz.haptic", "fuzz.ahap", "fuzz.hjif", "fuzz.json" })
    {
        const auto read = readers::readClip (text, name);
        if (! read)
            checkWhole (read.error());
        else
        {
            for (const auto& note : read->notes)
                checkWhole (note);
            tryWholeClip (read->clip);
        }
    }
    ClipVoice voice;
    if (const auto read = readers::readCalibration (text, "fuzz.acf", voice); ! read) checkWhole (read.error());
}

}   // namespace tactus::fuzz
