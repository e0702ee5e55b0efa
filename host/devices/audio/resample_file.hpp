// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

namespace tactus::host::audio
{

/// A whole recording at another sample rate, by libsamplerate's best sinc. Does not shift it in time. Throws std::bad_alloc. [any thread]
std::vector<float> resampled (std::vector<float> samples, double from_hz, double to_hz);

}   // namespace tactus::host::audio
