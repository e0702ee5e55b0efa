// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tactus::host
{

/// Appends a little-endian integer.
void appendInteger (std::string& out, std::uint64_t value, int bytes);

/// The samples of a WAV that is written.
enum class SampleFormat
{
    pcm16,   ///< integers, -32768 to 32767
    pcm24,   ///< integers, -8388608 to 8388607
    float32
};

constexpr std::size_t bytesOf (SampleFormat f) noexcept { return f == SampleFormat::pcm16 ? 2 : f == SampleFormat::pcm24 ? 3
                                                                                                                         : 4; }

/// The header of a WAV, in a layout that leaves room for the sizes of RF64 (EBU Tech 3306): files beyond 4 GB become one. Floats have a chunk `fact` and
/// an extension of `fmt `, which is empty here (Microsoft, "Multiple channel audio data and WAVE files").
std::string wavHeader (double rate_hz, std::size_t channels, std::uint64_t frames, SampleFormat = SampleFormat::float32);

}   // namespace tactus::host
