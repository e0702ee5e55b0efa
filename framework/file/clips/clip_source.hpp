// SPDX-License-Identifier: MIT
#pragma once

#include "clip_file.hpp"

#include <tactus/kit/signal/clip.hpp>

#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace tactus::readers
{

/// The times at which samples are taken: (k + offset) / rate, for k from 0 to count - 1.
struct SampleTimes
{
    double rate_hz = 8000.0, offset = 0.0;
    std::size_t count = 0;

    double operator[] (std::size_t k) const noexcept { return (static_cast<double> (k) + offset) / rate_hz; }
};

/// The samples of each channel.
using ChannelSamples = std::map<int, std::vector<double>>;

/// Recordings and options with which a file is rendered, besides its text.
struct SourceParts
{
    ClipSounds sounds {};    ///< the recordings of an .ahap by their paths; one that is missing is silent
    bool is_mixed = false;   ///< the channels of an .hjif are for adding up: each times its mixing weight, if there are several
};

/// Renders a clip file straight from its text, as its format defines its sound, and not by way of a Clip. It shares no rule with the readers, so
/// that the two can be compared:
///
///     .hjif     as the reference software of MPEG does: bands add up, and their sum is limited to -1 to 1 before the gain
///     .ahap     amplitude = intensity squared; frequency = sharpness squared, except for transients; each event begins at phase 0;
///               recordings, times their volume, on the channels from 2 on
///     .haptic   one tone that runs on through silence, and transients of two cycles
///
/// `voice` gives the frequencies of 0 and 1 where a format has none. Empty for other formats, whose files hold what a clip holds, and for files that
/// cannot be read. What neither of the two knows is not in the samples: wavelets, composite effects and the tones of a phone, which the notes of the readers
/// name. [main thread]
std::optional<ChannelSamples> renderFile (std::string_view text, std::string_view name, const ClipVoice& voice, const SampleTimes&,
                                          const SourceParts& parts = {});

/// The same of a clip. All tones are heard, however fast.
ChannelSamples renderSamples (const Clip&, const SampleTimes&);

}   // namespace tactus::readers
