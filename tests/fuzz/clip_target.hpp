// SPDX-License-Identifier: MIT
#pragma once

#include "whole_clip.hpp"
#include "whole_error.hpp"

#include <tactus/file/clips/clip_file.hpp>
#include <tactus/file/clips/clip_source.hpp>

#include <cstdlib>
#include <limits>
#include <string>
#include <string_view>

namespace tactus::fuzz
{

/// A recording for any path whose length is even: short and odd.
inline Result<Signal> soundFor (const std::string& path)
{
    if (path.size() % 2 != 0) return Message::error ("clip/sound", path, "there is no such file beside the clip", "put it there");
    return Signal { .rate_hz = 100.0, .channels = { { 0.5, 2.0, std::numeric_limits<double>::quiet_NaN() }, { -1.0, 0.0, 1e300 } } };
}

/// Reads the text as each kind of clip and as a calibration. Either it is a whole clip, or reading reports an error with its location.
/// Aborts otherwise.
inline void tryClip (std::string_view text)
{
    for (const auto* name : { "fuzz.haptic", "fuzz.ahap", "fuzz.hjif", "fuzz.json" })
    {
        const auto read = readers::readClip (text, name, soundFor);
        if (! read)
            checkWhole (read.error());
        else
        {
            for (const auto& note : read->notes)
                checkWhole (note);
            tryWholeClip (read->clip);
            const readers::SampleTimes times { .rate_hz = 100.0, .offset = 0.4142, .count = 100 };
            if (read->clip.events() < 10'000)
                if (const auto samples = readers::renderFile (text, name, ClipVoice {}, times, { read->sounds, true }))
                    for (const auto& [channel, values] : *samples)
                        if (values.size() != times.count) std::abort();
        }
    }
    ClipVoice voice;
    if (const auto read = readers::readCalibration (text, "fuzz.acf", voice); ! read) checkWhole (read.error());
}

}   // namespace tactus::fuzz
