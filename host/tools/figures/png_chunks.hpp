// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// The signature with which a PNG begins (PNG specification, 5.2).
inline constexpr std::string_view png_signature { "\x89PNG\r\n\x1a\n", 8 };

struct PngChunk
{
    std::string type;   ///< four letters
    std::string data;

    /// The chunk as it is written: length, type, data and checksum (PNG specification, 5.3).
    std::string bytes() const;
};

/// The chunks of a PNG. Stops before a chunk that is cut off or has a wrong checksum.
std::vector<PngChunk> chunksOf (std::string_view png);

/// A number as PNG stores it, most significant byte first.
std::string bigEndian (std::uint32_t value, int bytes = 4);
std::uint32_t readBigEndian (std::string_view bytes);

}   // namespace tactus::host
