// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>
#include <tactus/kit/clip.hpp>
#include <tactus/text/message.hpp>

#include <string>

namespace tactus::readers
{

/// A recording as a clip: a wave on each channel, with the rate as a note. Values beyond -1 to 1 are scaled to it, all channels by the same
/// factor. Warnings: clip/changed, clip/not_carried. [main thread]
Clip clipOfSignal (const Signal&, Messages& notes);

/// Scales waves to -1 to 1, all by the same factor. `what` is the place for the warning clip/changed.
void scaleWaves (Clip&, const std::string& what, Messages& notes);

}   // namespace tactus::readers
