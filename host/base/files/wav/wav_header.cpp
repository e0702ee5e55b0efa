// SPDX-License-Identifier: MIT
#include "wav_header.hpp"

#include <algorithm>

namespace tactus::host
{

void appendInteger (std::string& out, std::uint64_t value, int bytes)
{
    for (int i = 0; i < bytes; ++i)
        out += static_cast<char> (value >> 8 * i & 0xff);
}

std::string wavHeader (double rate_hz, std::size_t channels, std::uint64_t frames, SampleFormat format)
{
    const bool is_float = format == SampleFormat::float32;
    const std::uint64_t format_bytes = is_float ? 18 : 16, before_data = 12 + (8 + 28) + (8 + format_bytes) + (is_float ? 8 + 4 : 0) + 8;
    constexpr std::uint64_t see_ds64 = 0xffffffff;
    const auto rate = static_cast<std::uint64_t> (rate_hz), frame_bytes = channels * bytesOf (format);
    const auto bytes = frames * frame_bytes, size = before_data - 8 + bytes + bytes % 2;   // a chunk has an even number of bytes
    const bool is_large = size >= see_ds64;

    std::string out = is_large ? "RF64" : "RIFF";
    appendInteger (out, is_large ? see_ds64 : size, 4);
    out += is_large ? "WAVEds64" : "WAVEJUNK";
    appendInteger (out, 28, 4);
    appendInteger (out, is_large ? size : 0, 8);
    appendInteger (out, is_large ? bytes : 0, 8);
    appendInteger (out, is_large ? frames : 0, 8);
    appendInteger (out, 0, 4);
    out += "fmt ";
    appendInteger (out, format_bytes, 4);
    appendInteger (out, is_float ? 3 : 1, 2);   // WAVE_FORMAT_IEEE_FLOAT, WAVE_FORMAT_PCM
    appendInteger (out, channels, 2);
    appendInteger (out, rate, 4);
    appendInteger (out, rate * frame_bytes, 4);
    appendInteger (out, frame_bytes, 2);
    appendInteger (out, 8 * bytesOf (format), 2);
    if (is_float)
    {
        appendInteger (out, 0, 2);
        out += "fact";
        appendInteger (out, 4, 4);
        appendInteger (out, std::min (frames, see_ds64), 4);
    }
    out += "data";
    appendInteger (out, is_large ? see_ds64 : bytes, 4);
    return out;
}

}   // namespace tactus::host
