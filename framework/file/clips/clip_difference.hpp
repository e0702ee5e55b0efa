// SPDX-License-Identifier: MIT
#pragma once

#include "clip_source.hpp"

#include <vector>

namespace tactus::readers
{

/// The difference between the rendered envelopes of two clips in one channel. Both are rendered by ClipScore, at 2 kHz.
struct ChannelDifference
{
    int channel = 1;
    double duration = 0.0;     ///< of the longer one, s
    double rms = 0.0;          ///< of the first envelope
    double difference = 0.0;   ///< rms of the difference of the envelopes
    double frequency = 0.0;    ///< rms of the difference of the frequencies where both sound, Hz

    /// The difference relative to the first envelope, or to 1 if that is silent.
    double part() const noexcept { return rms > 0.0 ? difference / rms : difference; }
};

/// Compares each channel. If `mixed`, all channels of the first are added up and compared with all of the second, as for a format
/// with one channel. If only one of them has waves, their envelopes are compared. Clips longer than 10 min are compared in their first 10 min. [main thread]
std::vector<ChannelDifference> compareClips (const Clip& first, const Clip& second, bool mixed);

/// The difference between the samples of two renderings. Channel 0 is the sum of all.
struct SampleDifference
{
    int channel = 0;
    double rms = 0.0, difference = 0.0;   ///< of the first one; of the difference

    /// The difference relative to the first one, or to 1 if that is silent.
    double part() const noexcept { return rms > 0.0 ? difference / rms : difference; }
};

/// Compares each channel, or the sums of all channels if `mixed`. A channel that one of them lacks is silent there.
std::vector<SampleDifference> compareSamples (const ChannelSamples& first, const ChannelSamples& second, bool mixed);

}   // namespace tactus::readers
