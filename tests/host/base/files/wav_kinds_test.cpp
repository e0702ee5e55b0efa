// SPDX-License-Identifier: MIT
// Random recordings as programs write them. The test knows the samples, so the reader must give them to the bit, or refuse the file with the reason that is so.
#include <host/base/files/wav.hpp>

#include "support/temporary_folder.hpp"

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

using namespace tactus;
using namespace tactus::host;

namespace
{
constexpr int files = 300;

struct Random
{
    std::mt19937 engine { 24 };

    int below (int n) { return static_cast<int> (engine() % static_cast<unsigned> (n)); }
    bool once_in (int n) { return below (n) == 0; }
};

void append (std::string& bytes, std::uint64_t v, int size)
{
    for (int i = 0; i < size; ++i)
        bytes += static_cast<char> (static_cast<unsigned char> (v >> 8 * i));
}

struct Written
{
    std::string bytes {}, why {};   ///< `why`: words of the reason for which it must be refused; empty if it must be read
    std::vector<std::vector<double>> channels {};
    double rate_hz = 0.0;
};

std::string chunk (const std::string& name, const std::string& content, std::uint64_t size)
{
    std::string bytes = name;
    append (bytes, size, 4);
    bytes += content;
    if (content.size() % 2 == 1) bytes += '\0';
    return bytes;
}

std::string chunk (const std::string& name, const std::string& content) { return chunk (name, content, content.size()); }

/// A sample of a kind, as its bits and as its value.
double sample (Random& random, bool is_float, int bits, std::string& bytes)
{
    const auto raw = random.engine();
    if (is_float)
    {
        const float v = static_cast<float> (static_cast<double> (raw) / 2147483648.0 - 1.0);
        if (bits == 32)
            append (bytes, std::bit_cast<std::uint32_t> (v), 4);
        else
            append (bytes, std::bit_cast<std::uint64_t> (double { v }), 8);
        return v;
    }
    const auto whole = static_cast<std::int64_t> (raw >> (32 - bits)) - (std::int64_t { 1 } << (bits - 1));
    append (bytes, static_cast<std::uint64_t> (bits == 8 ? whole + 128 : whole), bits / 8);   // 8 bits have no sign
    return std::ldexp (static_cast<double> (whole), 1 - bits);
}

Written written (Random& random)
{
    Written made;
    const bool is_float = random.once_in (3), is_extensible = random.once_in (3);
    static constexpr int sizes[] { 8, 16, 24, 32 };
    const int bits = is_float ? 32 + 32 * random.below (2) : sizes[random.below (4)], channels = 1 + random.below (3), frames = 1 + random.below (40);
    const std::uint32_t hertz = 1000 + static_cast<std::uint32_t> (random.below (47000));
    made.rate_hz = hertz;
    made.channels.assign (static_cast<std::size_t> (channels), {});
    std::string data;
    for (int k = 0; k < frames; ++k)
        for (auto& channel : made.channels)
            channel.push_back (sample (random, is_float, bits, data));

    // The number of its defect; the largest numbers stand for none.
    const int defect = random.below (12);
    int code = is_float ? 3 : 1, written_bits = bits, written_channels = channels;
    std::uint32_t written_hertz = hertz;
    int frame = channels * bits / 8;
    if (defect == 0)
    {
        static const std::pair<int, const char*> kinds[] { { 2, "ADPCM" }, { 6, "A-law" }, { 7, "mu-law" }, { 85, "MP3" } };
        const auto& [number, name] = kinds[random.below (4)];
        code = number;
        made.why = name;
    }
    else if (defect == 1)
        written_bits = is_float ? 16 : 12, made.why = is_float ? "floats of 16 bits" : "integers of 12 bits";
    else if (defect == 2)
        written_channels = 0, made.why = "0 channels";
    else if (defect == 3)
        written_hertz = 0, made.why = "0 samples per second";
    else if (defect == 4)
        frame += 1, made.why = "bytes for " + std::to_string (channels) + " samples";
    std::string format;
    append (format, is_extensible ? 0xfffeu : static_cast<unsigned> (code), 2);
    append (format, static_cast<unsigned> (written_channels), 2);
    append (format, written_hertz, 4);
    append (format, std::uint64_t { written_hertz } * static_cast<unsigned> (frame), 4);
    append (format, static_cast<unsigned> (frame), 2);
    append (format, static_cast<unsigned> (written_bits), 2);
    if (is_extensible)
    {
        append (format, 22, 2);
        append (format, static_cast<unsigned> (bits), 2);
        append (format, 0, 4);
        append (format, static_cast<unsigned> (code), 2);
        format += std::string ("\x00\x00\x00\x00\x10\x00\x80\x00\x00\xaa\x00\x38\x9b\x71", 14);
    }

    const bool is_long = random.once_in (5);
    const int unknown = is_long ? 0 : random.below (6);
    std::uint64_t size = data.size();
    if (unknown == 1) size = 0xffffffff;
    if (unknown == 2 && ! data.starts_with (std::string (4, '\0'))) size = 0;
    std::string body;
    if (random.once_in (3)) body += chunk ("LIST", std::string ("INFOISFT\x05\0\0\0abcde\0", 18).substr (0, 15 + static_cast<std::size_t> (random.below (4))));
    body += chunk ("fmt ", format);
    if (random.once_in (4)) body += chunk ("JUNK", std::string (static_cast<std::size_t> (random.below (9)), 'x'));
    const bool is_last = size != data.size() || random.once_in (2);
    if (made.why.empty() && defect == 5 && size == data.size() && data.size() > 8)
    {
        data.resize (data.size() / 2);   // cut off, so that nothing may follow
        made.why = "more samples than the file contains";
    }
    body += chunk ("data", data, is_long ? 0xffffffff : size);
    if (is_last && data.size() % 2 == 1) body.pop_back();   // some programs leave the pad byte out at the end
    if (! is_last && made.why.empty()) body += chunk ("LIST", "INFOabcd") + chunk ("id3 ", "xyz");

    if (is_long)
    {
        std::string sizes_in_file;
        append (sizes_in_file, body.size() + 40, 8);
        append (sizes_in_file, size, 8);
        append (sizes_in_file, static_cast<std::uint64_t> (frames), 8);
        append (sizes_in_file, 0, 4);
        body = chunk ("ds64", sizes_in_file) + body;
    }
    made.bytes = is_long ? random.once_in (2) ? "RF64" : "BW64" : "RIFF";
    append (made.bytes, is_long || size == 0xffffffff ? 0xffffffff : body.size() + 4, 4);
    made.bytes += "WAVE" + body;
    if (defect == 6)
    {
        made.bytes.replace (0, 4, random.once_in (2) ? "RIFX" : "OggS");
        made.why = made.bytes[0] == 'R' ? "big-endian" : "does not begin with 'RIFF'";
    }
    return made;
}
}   // namespace

TEST_CASE ("300 random recordings are read to the bit, or refused for what is wrong with them", "[wav]")
{
    const TemporaryFolder folder;
    Random random;
    int refused = 0;
    for (int n = 0; n < files; ++n)
    {
        const auto file = written (random);
        folder.write ("a.wav", file.bytes);
        const auto read = readWav (folder / "a.wav");
        INFO ("file " << n << (file.why.empty() ? "" : ", wrong: " + file.why) << (read ? "" : ": " + describe (read.error())));
        if (! file.why.empty())
        {
            ++refused;
            REQUIRE (! read);
            CHECK (read.error().text.find (file.why) != std::string::npos);
            continue;
        }
        REQUIRE (read);
        CHECK (read->rate_hz == file.rate_hz);
        CHECK (read->channels == file.channels);
    }
    CHECK (refused > files / 4);
    CHECK (refused < 3 * files / 4);
}
