// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/csv.hpp>
#include <tactus/kit/signal/clip.hpp>
#include <tactus/text/message.hpp>
#include <tactus/text/result.hpp>

#include <string>
#include <vector>

namespace tactus::host
{

/// A table as a clip: the rows of a clip (kind, track, a, b, c), or a column t (or time) with columns value, amplitude and sharpness, each
/// with _2, _3 and so on for further channels. `name` is for messages. Error: clip/columns, clip/range.
Result<Clip> clipOfTable (const Table&, const std::string& name, Messages& notes);

/// One sample of each channel after the other.
struct RenderedClip
{
    std::vector<int> channels;
    std::vector<std::vector<double>> value, amplitude, frequency;   // by channel
};

/// The signal of each channel at this rate, from 0 to the end of the clip.
RenderedClip renderClip (const Clip&, double rate_hz);

}   // namespace tactus::host
