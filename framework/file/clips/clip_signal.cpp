// SPDX-License-Identifier: MIT
#include "clip_signal.hpp"

#include <tactus/kit/vec3.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace tactus::readers
{

void scaleWaves (Clip& clip, const std::string& what, Messages& notes)
{
    double most = 1.0;
    for (const auto& t : clip.tracks)
        for (const auto& p : t.amplitude)
            most = std::max (most, std::abs (p.value));
    if (most <= 1.0) return;
    for (auto& t : clip.tracks)
        for (auto& p : t.amplitude)
            p.value /= most;
    notes.push_back (Message::warning ("clip/changed", what, "the values are divided by " + numberText (most) + ", so that they are at most 1",
                                       "set the gain of signal.clip to " + numberText (most)));
}

namespace
{
void noteNonFinite (const std::vector<double>& samples, double rate_hz, int channel, Messages& notes)
{
    const auto isBad = [] (double v) { return ! std::isfinite (v); };
    const auto first = std::ranges::find_if (samples, isBad);
    if (first == samples.end()) return;
    const auto count = std::count_if (first, samples.end(), isBad);
    notes.push_back (Message::warning ("clip/not_finite", "channel " + std::to_string (channel),
                                       std::to_string (count) + (count == 1 ? " sample is" : " samples are") + " not a finite number, the first at "
                                           + numberText (static_cast<double> (first - samples.begin()) / rate_hz) + " s; 0 is used instead",
                                       "check the program that wrote the recording"));
}
}   // namespace

Clip clipOfSignal (const Signal& signal, Messages& notes)
{
    Clip clip;
    clip.notes.emplace_back ("rate", numberText (signal.rate_hz));
    for (const auto& samples : signal.channels)
    {
        if (clip.tracks.size() >= at (most_clip_tracks))
        {
            notes.push_back (Message::warning ("clip/not_carried", "channels", "those after the first " + std::to_string (most_clip_tracks) + " are left out",
                                               "convert them from a separate file"));
            break;
        }
        auto& track = clip.tracks.emplace_back (ClipTrack { .channel = static_cast<int> (clip.tracks.size()) + 1, .is_wave = true });
        track.amplitude.reserve (samples.size() + 1);
        for (std::size_t i = 0; i < samples.size(); ++i)
            track.amplitude.push_back ({ static_cast<double> (i) / signal.rate_hz, finiteOrZero (samples[i]) });
        // The last sample lasts as long as the others.
        if (! samples.empty()) track.amplitude.push_back ({ static_cast<double> (samples.size()) / signal.rate_hz, finiteOrZero (samples.back()) });
        noteNonFinite (samples, signal.rate_hz, track.channel, notes);
    }
    scaleWaves (clip, "samples", notes);
    return clip;
}

}   // namespace tactus::readers
