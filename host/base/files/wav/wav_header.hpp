// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace tactus::host
{

/// Appends a little-endian integer.
void appendInteger (std::string& out, std::uint64_t value, int bytes);

/// The header of a WAV with 32-bit floats, in a layout that leaves room for the sizes of RF64 (EBU Tech 3306): files beyond 4 GB become one. Formats
/// other than integers have a chunk `fact` and an extension of `fmt `, which is empty here (Microsoft, "Multiple channel audio data and WAVE files").
std::string wavHeader (double rate_hz, std::size_t channels, std::uint64_t frames);

}   // namespace tactus::host
