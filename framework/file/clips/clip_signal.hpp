// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/assets.hpp>
#include <tactus/kit/signal/clip.hpp>
#include <tactus/text/message.hpp>

#include <string>

namespace tactus::readers
{

/// Converts a recording to a clip: a wave on each channel, and a note with the rate. If a value is outside -1 to 1, all channels are divided by
/// the same factor; a value that is not finite becomes 0. Warnings: clip/changed, clip/not_carried, clip/not_finite. [main thread]
Clip clipOfSignal (const Signal&, Messages& notes);

/// Divides all waves by the same factor if a value is outside -1 to 1. `what` is the location in the warning clip/changed.
void scaleWaves (Clip&, const std::string& what, Messages& notes);

}   // namespace tactus::readers
