// SPDX-License-Identifier: GPL-3.0-or-later
#include "png_density.hpp"

#include <cmath>
#include <cstdint>
#include <string_view>

namespace tactus::host
{

namespace
{
/// The checksum of a chunk (PNG specification, annex D).
std::uint32_t crcOf (std::string_view bytes)
{
    std::uint32_t crc = 0xffffffff;
    for (const char c : bytes)
    {
        crc ^= static_cast<unsigned char> (c);
        for (int bit = 0; bit < 8; ++bit)
            crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
    }
    return ~crc;
}

std::string bigEndian (std::uint32_t value)
{
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
        bytes += static_cast<char> (value >> shift & 0xff);
    return bytes;
}
}   // namespace

std::string withDensity (std::string png, double dpi)
{
    constexpr std::size_t after_header = 8 + 4 + 4 + 13 + 4;   // the signature and the chunk IHDR, which comes first
    const auto per_metre = bigEndian (static_cast<std::uint32_t> (std::lround (dpi / 25.4e-3)));
    const auto chunk = "pHYs" + per_metre + per_metre + '\1';
    return png.insert (after_header, bigEndian (9) + chunk + bigEndian (crcOf (chunk)));
}

}   // namespace tactus::host
