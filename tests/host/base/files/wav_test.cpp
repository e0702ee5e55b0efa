// SPDX-License-Identifier: MIT
#include <host/base/files/wav.hpp>

#include "support/temporary_folder.hpp"

#include <support/property.hpp>

#include <catch2/catch.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

using namespace tactus::host;

namespace
{
/// Little-endian bytes of a WAV's header and data.
struct Bytes
{
    std::string text;

    Bytes& ascii (std::string_view four) { return text += four, *this; }
    Bytes& u16 (std::uint32_t value) { return text += static_cast<char> (value & 255), text += static_cast<char> (value >> 8 & 255), *this; }
    Bytes& u32 (std::uint32_t value) { return u16 (value & 65535).u16 (value >> 16); }
};

std::string wavOf (std::uint32_t format, std::uint32_t channels, std::uint32_t bits, const std::string& data, std::uint32_t claimed_size)
{
    const auto frame = channels * bits / 8;
    return Bytes()
        .ascii ("RIFF")
        .u32 (36 + claimed_size)
        .ascii ("WAVEfmt ")
        .u32 (16)
        .u16 (format)
        .u16 (channels)
        .u32 (8000)
        .u32 (8000 * frame)
        .u16 (frame)
        .u16 (bits)
        .ascii ("data")
        .u32 (claimed_size)
        .ascii (data)
        .text;
}

std::uint32_t u32At (const std::string& bytes, std::size_t at)
{
    std::uint32_t value = 0;
    for (std::size_t i = 4; i-- > 0;)
        value = value << 8 | static_cast<unsigned char> (bytes.at (at + i));
    return value;
}

std::string createError (const std::filesystem::path& path, double sample_rate_hz, std::size_t channels)
{
    const auto writer = WavWriter::create (path, sample_rate_hz, channels);
    return writer ? "" : writer.error().id;
}
}   // namespace

TEST_CASE ("wav: every float reads back bit for bit, at any size and number of channels", "[host][io][wav]")
{
    const TemporaryFolder folder;

    const auto round_trip = [&] (const std::vector<std::uint32_t>& bits) {
        const auto channels = *rc::gen::inRange<std::size_t> (1, 12);
        const auto rate = *rc::gen::inRange (1, 1'000'000);
        const auto frames = bits.size() / channels;

        auto writer = WavWriter::create (folder / "out.wav", rate, channels);
        RC_ASSERT (writer.has_value());
        for (std::size_t k = 0; k < frames; ++k)
        {
            std::vector<double> samples;
            for (std::size_t channel = 0; channel < channels; ++channel)
                samples.push_back (std::bit_cast<float> (bits[k * channels + channel]));
            RC_ASSERT (writer->frame (samples).has_value());
        }
        RC_ASSERT (writer->commit().has_value());

        const auto recording = readWav (folder / "out.wav");
        RC_ASSERT (recording.has_value());
        RC_ASSERT (recording->rate_hz == rate);
        RC_ASSERT (recording->channels.size() == channels);
        for (std::size_t channel = 0; channel < channels; ++channel)
        {
            RC_ASSERT (recording->channels[channel].size() == frames);
            for (std::size_t k = 0; k < frames; ++k)
            {
                const auto written = std::bit_cast<float> (bits[k * channels + channel]);
                const auto read = static_cast<float> (recording->channels[channel][k]);
                const bool same_bits = std::bit_cast<std::uint32_t> (read) == std::bit_cast<std::uint32_t> (written);
                RC_ASSERT ((same_bits || (std::isnan (read) && std::isnan (written))));
            }
        }
    };

    tactus::test::property ("any bit pattern", round_trip);
}

TEST_CASE ("wav: forces beyond 1 N are neither clipped nor scaled", "[host][io][wav]")
{
    const TemporaryFolder folder;
    const auto infinity = std::numeric_limits<double>::infinity();
    auto writer = WavWriter::create (folder / "out.wav", 4000.0, 1);
    REQUIRE (writer.has_value());
    const std::vector<double> newtons { 0.0, 25.0, -1e6, 3.0e38, 0.5, infinity, -infinity, 1e300 };
    for (const double force : newtons)
        REQUIRE (writer->frame ({ &force, 1 }).has_value());
    REQUIRE (writer->commit().has_value());

    const auto read = readWav (folder / "out.wav");
    REQUIRE (read.has_value());
    CHECK (read->channels[0][1] == 25.0);
    CHECK (read->channels[0][2] == -1e6);
    CHECK (read->channels[0][3] == Approx (3.0e38));
    CHECK (read->channels[0][5] == infinity);
    CHECK (read->channels[0][6] == -infinity);
    CHECK (read->channels[0][7] == infinity);   // out of the range of a float
}

TEST_CASE ("wav: the header has format 32-bit float and the right sizes", "[host][io][wav]")
{
    const TemporaryFolder folder;
    const std::size_t channels = 3, frames = 2500;   // more than one block
    auto writer = WavWriter::create (folder / "out.wav", 10'000.0, channels);
    REQUIRE (writer.has_value());
    for (std::size_t k = 0; k < frames; ++k)
        REQUIRE (writer->frame (std::vector<double> (channels, 1.0)).has_value());
    REQUIRE (writer->commit().has_value());

    const auto bytes = folder.textOf ("out.wav");
    const auto fmt = bytes.find ("fmt ");
    const auto data = bytes.find ("data");
    REQUIRE (fmt != std::string::npos);
    REQUIRE (data != std::string::npos);
    CHECK (bytes.substr (0, 4) == "RIFF");
    CHECK (u32At (bytes, 4) == bytes.size() - 8);
    CHECK ((u32At (bytes, fmt + 8) & 0xffff) == 3);   // WAVE_FORMAT_IEEE_FLOAT
    CHECK (u32At (bytes, fmt + 8) >> 16 == channels);
    CHECK (u32At (bytes, fmt + 12) == 10'000);
    CHECK (u32At (bytes, fmt + 20) >> 16 == 32);
    CHECK (u32At (bytes, data + 4) == channels * frames * 4);
    CHECK (bytes.size() == data + 8 + channels * frames * 4);
}

TEST_CASE ("wav: a recording without samples is a complete file", "[host][io][wav]")
{
    const TemporaryFolder folder;
    auto writer = WavWriter::create (folder / "out.wav", 1000.0, 2);
    REQUIRE (writer.has_value());
    REQUIRE (writer->commit().has_value());

    const auto read = readWav (folder / "out.wav");
    REQUIRE (read.has_value());
    CHECK (read->channels.size() == 2);
    CHECK (read->channels[0].empty());
}

TEST_CASE ("wav: an unfinished recording leaves no file", "[host][io][wav]")
{
    const TemporaryFolder folder;
    {
        auto writer = WavWriter::create (folder / "out.wav", 1000.0, 1);
        REQUIRE (writer.has_value());
        REQUIRE (writer->frame (std::vector { 1.0 }).has_value());
    }
    CHECK (folder.isEmpty());
}

TEST_CASE ("wav: an unfinished recording can be read up to the last flush", "[host][io][wav]")
{
    const TemporaryFolder folder;
    auto writer = WavWriter::create (folder / "out.wav", 1000.0, 2, tactus::IfKilled::kept);
    REQUIRE (writer.has_value());
    std::size_t written = 0;
    const auto write = [&] (std::size_t frames) {
        for (std::size_t k = 0; k < frames; ++k, ++written)
            REQUIRE (writer->frame (std::vector { 1.0 * static_cast<double> (written), -1.0 }).has_value());
    };
    for (const std::size_t frames : { 0u, 1u, 1500u, 700u })
    {
        write (frames);
        REQUIRE (writer->flush().has_value());
        const auto flushed = written;
        write (1100);   // more than a block
        const auto read = readWav (folder / "out.partial.wav");
        REQUIRE (read.has_value());
        REQUIRE (read->channels[0].size() == flushed);
        if (flushed > 0) CHECK (read->channels[0].back() == static_cast<double> (flushed - 1));
    }
    REQUIRE (writer->commit().has_value());
    const auto read = readWav (folder / "out.wav");
    REQUIRE (read.has_value());
    REQUIRE (read->channels[0].size() == written);
    for (std::size_t k = 0; k < written; ++k)
        REQUIRE (read->channels[0][k] == static_cast<double> (k));
}

TEST_CASE ("wav: unsupported sample rates and channel counts are refused", "[host][io][wav]")
{
    const TemporaryFolder folder;

    for (const double rate : { 0.0, -48'000.0, 999.5, 1e300, std::nan (""), std::numeric_limits<double>::infinity() })
        CHECK (createError (folder / "out.wav", rate, 1) == "wav/sample_rate");
    CHECK (createError (folder / "out.wav", 1e6, 1000) == "wav/sample_rate");   // bytes per second overflow
    CHECK (createError (folder / "out.wav", 1000.0, 0) == "wav/channels");
    CHECK (createError (folder / "out.wav", 1000.0, 1441) == "wav/channels");
    CHECK (createError (folder / "out.wav", 1000.0, 1440).empty());
    CHECK (createError (folder / "missing/out.wav", 1000.0, 1) == "output/unwritable");
    CHECK (folder.isEmpty());
}

TEST_CASE ("wav: a file with the maximum number of channels can be written and read", "[host][io][wav]")
{
    const TemporaryFolder folder;
    auto writer = WavWriter::create (folder / "out.wav", 1000.0, 1440);
    REQUIRE (writer.has_value());
    std::vector<double> samples (1440, 0.0);
    samples.back() = 7.0;
    REQUIRE (writer->frame (samples).has_value());
    CHECK (writer->frame (std::vector<double> (2)).error().id == "wav/channels");
    REQUIRE (writer->commit().has_value());

    CHECK (readWav (folder / "out.wav")->channels[1439] == std::vector { 7.0 });
}

TEST_CASE ("wav: a full disk is an error", "[host][io][wav]")
{
    if (! std::filesystem::exists ("/dev/full"))
        return;

    auto writer = WavWriter::create ("/dev/full", 1000.0, 1);
    REQUIRE (writer.has_value());
    tactus::Result<> written;
    for (int k = 0; k < 100'000 && written; ++k)
        written = writer->frame (std::vector { 1.0 });

    REQUIRE_FALSE (written.has_value());
    CHECK (written.error().id == "output/unwritable");
}

TEST_CASE ("wav: integer samples are read as -1 to 1", "[host][io][wav]")
{
    const TemporaryFolder folder;
    folder.write ("int16.wav", wavOf (1, 1, 16, Bytes().u16 (0x8000).u16 (0x4000).u16 (1).u16 (0).text, 8));
    folder.write ("int32.wav", wavOf (1, 1, 32, Bytes().u32 (0x80000000).u32 (1).text, 8));

    CHECK (readWav (folder / "int16.wav")->channels[0] == std::vector { -1.0, 0.5, std::ldexp (1.0, -15), 0.0 });
    CHECK (readWav (folder / "int32.wav")->channels[0] == std::vector { -1.0, std::ldexp (1.0, -31) });
}

TEST_CASE ("wav: a file that is not a recording is refused, each error with its id", "[host][io][wav]")
{
    const TemporaryFolder folder;
    const std::string samples (64, '\0');
    folder.write ("text.wav", "t,x\n0,1\n");
    folder.write ("empty.wav", "");
    folder.write ("half.wav", wavOf (3, 1, 16, samples, 64));
    folder.write ("twelve.wav", wavOf (1, 1, 12, samples, 64));
    folder.write ("mulaw.wav", wavOf (7, 1, 8, samples, 64));
    folder.write ("none.wav", wavOf (1, 0, 16, samples, 64));
    folder.write ("short.wav", wavOf (3, 1, 32, samples, 4'000'000'000u));
    folder.write ("wide.wav", wavOf (3, 2000, 32, samples, 64));
    folder.write ("one_short.wav", wavOf (3, 1, 32, samples, 68));
    folder.write ("doubles_short.wav", wavOf (3, 1, 64, samples, 72));

    for (const auto* name : { "text.wav", "empty.wav", "half.wav", "twelve.wav", "mulaw.wav", "none.wav" })
    {
        CAPTURE (name);
        CHECK (readWav (folder / name).error().id == "wav/not_a_wav");
    }
    CHECK (readWav (folder / "missing.wav").error().id == "wav/unreadable");
    for (const auto* name : { "short.wav", "one_short.wav", "doubles_short.wav" })
    {
        CAPTURE (name);
        const auto read = readWav (folder / name);
        CHECK ((! read && read.error().id == "wav/truncated"));
    }
    CHECK (readWav (folder / "wide.wav").error().id == "wav/too_many_channels");
}

TEST_CASE ("wav: metadata is skipped, however deep or long, and the samples are the same", "[host][io][wav]")
{
    const TemporaryFolder folder;
    const auto chunk = [] (std::string_view name, const std::string& content) {
        const auto size = static_cast<std::uint32_t> (content.size());
        return Bytes().ascii (name).u32 (size).ascii (content).ascii (size % 2 == 1 ? std::string (1, '\0') : "").text;
    };
    std::string deep;
    for (int i = 0; i < 100'000; ++i)
        deep += "<a>";
    const auto huge = std::numeric_limits<std::uint32_t>::max();
    const auto many = std::string (28, '\0') + Bytes().u32 (huge).u32 (0).text + std::string (240, '\1');   // the count of loops
    const auto metadata = chunk ("axml", deep) + chunk ("iXML", "<b>") + chunk ("smpl", many) + chunk ("cue ", Bytes().u32 (huge).text)
                          + chunk ("LIST", "adtl" + std::string (80, '\0')) + chunk ("bext", "x");

    const auto samples = Bytes().u32 (std::bit_cast<std::uint32_t> (0.1f)).u32 (std::bit_cast<std::uint32_t> (-25.0f)).text;
    const auto plain = wavOf (3, 1, 32, samples, 8);
    const auto withMetadata = [&] (std::size_t at) {
        auto bytes = plain;
        bytes.insert (at, metadata);
        return bytes.replace (4, 4, Bytes().u32 (static_cast<std::uint32_t> (bytes.size() - 8)).text);
    };
    for (const auto at : { std::size_t { 12 }, plain.find ("data"), plain.size() })   // before the format, before the samples, at the end
    {
        CAPTURE (at);
        folder.write ("full.wav", withMetadata (at));
        const auto read = readWav (folder / "full.wav");
        REQUIRE (read.has_value());
        CHECK (read->rate_hz == 8000.0);
        CHECK (read->channels.at (0) == std::vector<double> { 0.1f, -25.0f });
    }
}

TEST_CASE ("wav: an RF64 file states the size of its samples in its first chunk", "[host][io][wav]")
{
    const TemporaryFolder folder;
    const auto fmt = wavOf (1, 1, 16, "", 0).substr (12, 24);
    const auto rf64 = [&] (std::uint32_t bytes) {
        return Bytes().ascii ("RF64").u32 (0xffffffff).ascii ("WAVEds64").u32 (28).u32 (76).u32 (0).u32 (bytes).u32 (0).u32 (0).u32 (0).u32 (0).ascii (fmt).text
               + Bytes().ascii ("data").u32 (0xffffffff).u16 (0x4000).u16 (0x8000).text;
    };
    folder.write ("whole.wav", rf64 (4));
    folder.write ("short.wav", rf64 (4'000'000));
    const auto read = readWav (folder / "whole.wav");
    REQUIRE (read.has_value());
    CHECK (read->channels.at (0) == std::vector { 0.5, -1.0 });
    CHECK (readWav (folder / "short.wav").error().id == "wav/truncated");
}

TEST_CASE ("wav: a file of thousands of empty chunks is refused", "[host][io][wav]")
{
    const TemporaryFolder folder;
    auto bytes = wavOf (1, 1, 16, "ab", 2);
    std::string empty;
    for (int i = 0; i < 2000; ++i)
        empty += Bytes().ascii ("JUNK").u32 (0).text;
    bytes.insert (12, empty);
    bytes.replace (4, 4, Bytes().u32 (static_cast<std::uint32_t> (bytes.size() - 8)).text);
    folder.write ("chunks.wav", bytes);
    CHECK (readWav (folder / "chunks.wav").error().id == "wav/not_a_wav");
}

TEST_CASE ("wav: no damaged header crashes the reader", "[host][io][wav]")
{
    const TemporaryFolder folder;
    const auto whole = wavOf (3, 2, 32, std::string (64, 'x'), 64);

    const auto damaged = [&] (const std::vector<std::pair<std::uint8_t, char>>& changes) {
        auto bytes = whole;
        for (const auto& [at, value] : changes)
            bytes[at % bytes.size()] = value;
        folder.write ("damaged.wav", bytes);
        if (const auto recording = readWav (folder / "damaged.wav"); ! recording)
            RC_ASSERT (recording.error().id.starts_with ("wav/"));
    };

    tactus::test::property ("any bytes changed", damaged);
}

TEST_CASE ("a WAV whose length is unknown has all samples of its file, and 64-bit floats are read", "[wav]")
{
    const TemporaryFolder folder;
    const std::string data = Bytes().u16 (0x1000).u16 (0x2000).u16 (0xf000).text;
    for (const std::uint32_t claimed : { 0u, 0xffffffffu, 0x7ffff000u })
    {
        auto bytes = wavOf (1, 1, 16, data, claimed);
        for (std::size_t i = 0; i < 4; ++i)
            bytes[4 + i] = static_cast<char> (claimed >> 8 * i & 255u);   // the size of the file is as unknown
        folder.write ("open.wav", bytes);
        const auto read = readWav (folder / "open.wav");
        REQUIRE (read);
        CHECK (read->channels == std::vector<std::vector<double>> { { 0.125, 0.25, -0.125 } });
    }
    folder.write ("stopped.wav", wavOf (1, 1, 16, data, 0));   // a program that ended before it wrote the sizes
    CHECK (readWav (folder / "stopped.wav")->channels.at (0).size() == 3);
    folder.write ("empty.wav", wavOf (1, 1, 16, "", 0) + Bytes().ascii ("LIST").u32 (4).ascii ("INFO").text);
    const auto empty = readWav (folder / "empty.wav");
    CHECK ((! empty || empty->channels.at (0).empty()));

    std::string doubles;
    for (const double v : { 0.5, -0.25, 1.0 / 3.0 })
    {
        const auto bits = std::bit_cast<std::uint64_t> (v);
        doubles += Bytes().u32 (static_cast<std::uint32_t> (bits)).u32 (static_cast<std::uint32_t> (bits >> 32)).text;
    }
    folder.write ("doubles.wav", wavOf (3, 1, 64, doubles, static_cast<std::uint32_t> (doubles.size())));
    const auto read = readWav (folder / "doubles.wav");
    REQUIRE (read);
    REQUIRE (read->channels.at (0).size() == 3);
    CHECK (read->channels[0][0] == 0.5);
    CHECK (read->channels[0][1] == -0.25);
    CHECK (read->channels[0][2] == Approx (1.0 / 3.0).epsilon (1e-7));
}
