// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <istream>
#include <string>

namespace tactus::host
{

/// The samples of a WAV file: their format, and where they are.
struct WavSamples
{
    bool is_float = false;
    unsigned bits = 0, channels = 0;   ///< bits: 8, 16, 24 or 32; of floats 32 or 64
    double rate_hz = 0.0;
    std::uint64_t start = 0;     ///< in bytes from the beginning of the file
    std::uint64_t claimed = 0;   ///< bytes of samples, as the header says; of a stream, which cannot say it: those to the end of the file
    std::uint64_t present = 0;   ///< bytes of samples that the file has
    std::string why {};          ///< the samples cannot be read, as a part of a sentence; empty if they can

    std::uint64_t frameBytes() const noexcept { return std::uint64_t { channels } * bits / 8; }
};

/// Finds the samples, in a RIFF or RF64 file, and skips the metadata. Refuses files that are not a WAV, and samples that are neither integers nor floats.
/// [any thread]
WavSamples findWavSamples (std::istream&);

}   // namespace tactus::host
