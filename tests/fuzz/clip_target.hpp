// SPDX-License-Identifier: MIT
#pragma once

#include "whole_clip.hpp"
#include "whole_error.hpp"

#include <tactus/file/clips/clip_file.hpp>

#include <string_view>

namespace tactus::fuzz
{

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
