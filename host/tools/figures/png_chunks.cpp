// SPDX-License-Identifier: MIT
#include "png_chunks.hpp"

#include <array>

namespace tactus::host
{

namespace
{
constexpr std::array<std::uint32_t, 256> crc_table = [] {
    std::array<std::uint32_t, 256> table {};
    for (std::uint32_t n = 0; n < 256; ++n)
    {
        auto c = n;
        for (int bit = 0; bit < 8; ++bit)
            c = (c >> 1) ^ ((c & 1u) != 0 ? 0xedb88320u : 0u);
        table[n] = c;
    }
    return table;
}();

/// The checksum of a chunk (PNG specification, annex D).
std::uint32_t crcOf (std::string_view bytes)
{
    std::uint32_t crc = 0xffffffff;
    for (const char c : bytes)
        crc = (crc >> 8) ^ crc_table[(crc ^ static_cast<unsigned char> (c)) & 0xff];
    return ~crc;
}
}   // namespace

std::string bigEndian (std::uint32_t value, int bytes)
{
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
        text += static_cast<char> (value >> shift & 0xff);
    return text;
}

std::uint32_t readBigEndian (std::string_view bytes)
{
    std::uint32_t value = 0;
    for (const char c : bytes)
        value = value << 8 | static_cast<unsigned char> (c);
    return value;
}

std::string PngChunk::bytes() const
{
    const auto checked = type + data;
    return bigEndian (static_cast<std::uint32_t> (data.size())) + checked + bigEndian (crcOf (checked));
}

std::vector<PngChunk> chunksOf (std::string_view png)
{
    constexpr std::size_t around = 12;   // length, type and checksum
    std::vector<PngChunk> chunks;
    if (! png.starts_with (png_signature)) return chunks;
    for (png.remove_prefix (png_signature.size()); png.size() >= around;)
    {
        const std::size_t length = readBigEndian (png.substr (0, 4));
        if (length > png.size() - around || readBigEndian (png.substr (8 + length, 4)) != crcOf (png.substr (4, 4 + length))) break;
        chunks.push_back ({ std::string (png.substr (4, 4)), std::string (png.substr (8, length)) });
        png.remove_prefix (around + length);
    }
    return chunks;
}

}   // namespace tactus::host
