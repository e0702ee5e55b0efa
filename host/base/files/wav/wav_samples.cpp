// SPDX-License-Identifier: GPL-3.0-or-later
#include "wav_samples.hpp"

#include <tactus/text/budget.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr int shortest_format = 16, longest_format = 40;   // bytes; an extensible format takes 40

/// No program writes this many chunks; a file of empty chunks would take millions of reads.
constexpr int most_chunks = 1000;

constexpr std::uint32_t unknown_size = 0xffffffff;

struct Chunks
{
    std::string format;
    std::optional<juce::int64> data_bytes;   // as claimed; none if there is no data chunk after the format
    juce::int64 data_start = 0;
};

std::string take (juce::InputStream& in, int bytes)
{
    std::string taken (static_cast<std::size_t> (bytes), '\0');
    taken.resize (static_cast<std::size_t> (std::max (0, in.read (taken.data(), bytes))));
    return taken;
}

/// The size of a chunk, which its name precedes.
juce::int64 takeSize (juce::InputStream& in) { return static_cast<std::uint32_t> (in.readInt()); }

juce::int64 padded (juce::int64 bytes) { return bytes + (bytes & 1); }

int numberAt (const std::string& format, std::size_t at) { return static_cast<unsigned char> (format[at]) | static_cast<unsigned char> (format[at + 1]) << 8; }

/// Why the samples of a format cannot be read, as a part of a sentence; empty if they can. The bits of an extensible format are those of its container: the
/// lowest of them may be 0.
std::string whyNot (const std::string& format)
{
    if (format.empty()) return "it has no chunk 'fmt ' before its samples";
    if (format.size() < shortest_format) return "its chunk 'fmt ' is too short";
    int code = numberAt (format, 0);
    if (code == 0xfffe)
    {
        if (format.size() < longest_format) return "its chunk 'fmt ' is too short for an extensible format";
        code = numberAt (format, 24);
    }
    const int channels = numberAt (format, 2), bits = numberAt (format, 14), bytes = numberAt (format, 12);
    using Named = std::pair<int, std::string_view>;
    static constexpr Named compressed[] { { 2, "ADPCM" }, { 6, "A-law" }, { 7, "mu-law" }, { 17, "IMA ADPCM" }, { 49, "GSM" }, { 80, "MPEG" }, { 85, "MP3" } };
    for (const auto& [known, name] : compressed)
        if (code == known) return "its samples are compressed, as " + std::string (name);
    if (code != 1 && code != 3) return "its samples have a format that is not read, of the number " + std::to_string (code);
    if (channels == 0) return "its header says 0 channels";
    if (numberAt (format, 4) == 0 && numberAt (format, 6) == 0) return "its header says 0 samples per second";
    const bool is_float = code == 3, fits = is_float ? bits == 32 || bits == 64 : bits == 8 || bits == 16 || bits == 24 || bits == 32;
    if (! fits) return "its samples are " + std::string (is_float ? "floats" : "integers") + " of " + std::to_string (bits) + " bits";
    if (bytes != 0 && bytes != channels * bits / 8)
        return "its header says " + std::to_string (bytes) + " bytes for " + std::to_string (channels) + " samples of " + std::to_string (bits) + " bits";
    return {};
}

/// The whole frames in a number of bytes.
juce::int64 wholeFrames (const std::string& format, juce::int64 bytes)
{
    const juce::int64 frame = format.size() >= shortest_format ? numberAt (format, 12) : 0;
    return frame > 0 ? std::max (juce::int64 { 0 }, bytes) / frame * frame : 0;
}

/// True if a chunk that may follow the samples begins here.
bool beginsAChunk (juce::InputStream& wav, juce::int64 at)
{
    wav.setPosition (at);
    const auto name = take (wav, 4);
    static constexpr std::string_view known[] { "LIST", "id3 ", "ID3 ", "fact", "bext", "cue ", "smpl", "iXML", "PEAK", "JUNK", "_PMX" };
    return std::ranges::find (known, name) != std::end (known);
}

/// True if the size of the samples stands for an unknown one, as programs write it that stream, or that end before they know it: the largest number; just
/// below 2 GB (sox and arecord), if the file is shorter; or 0 before other bytes, unless the chunk `fact` says 0 as well.
bool isUnknown (juce::InputStream& wav, std::uint64_t size, juce::int64 start, bool says_none)
{
    constexpr std::uint64_t near_2_gb = 0x7fff0000, past_2_gb = 0x80000000;
    if (size == unknown_size) return true;
    if (size == 0) return ! says_none && ! beginsAChunk (wav, start);
    return size >= near_2_gb && size <= past_2_gb && start + static_cast<juce::int64> (size) > wav.getTotalLength();
}

/// Finds the chunks as JUCE does: the claimed size of the file ends the search. None if the file is not a WAV; then `why` is the reason.
std::optional<Chunks> findChunks (juce::InputStream& wav, std::string& why)
{
    const auto kind = take (wav, 4);
    const bool is_rf64 = kind == "RF64" || kind == "BW64";   // two names of one layout
    why = kind.empty() ? "it is empty" : kind == "RIFX" ? "its numbers are big-endian (RIFX)"
                                                        : "it does not begin with 'RIFF' and 'WAVE'";
    if (! is_rf64 && kind != "RIFF") return std::nullopt;
    auto end = static_cast<std::uint64_t> (takeSize (wav)) + 8;
    // A program that streams cannot go back to write the sizes, and leaves 0 or the largest number.
    if (! is_rf64 && (end == 8 || end == std::uint64_t { unknown_size } + 8)) end = std::numeric_limits<std::uint64_t>::max();
    if (take (wav, 4) != "WAVE") return std::nullopt;

    std::optional<juce::int64> long_size;
    if (is_rf64)
    {
        why = "it has no chunk 'ds64', which holds its size";
        if (take (wav, 4) != "ds64") return std::nullopt;
        const auto size = takeSize (wav), start = wav.getPosition();
        if (size < 28) return std::nullopt;
        end = static_cast<std::uint64_t> (wav.readInt64()) + 8;
        long_size = wav.readInt64();
        wav.setPosition (start + padded (size));
    }

    Chunks found;
    bool says_none = false;
    for (int chunk = 0; static_cast<std::uint64_t> (wav.getPosition()) < end && ! wav.isExhausted(); ++chunk)
    {
        if (chunk == most_chunks)
        {
            why = "it has more than " + std::to_string (most_chunks) + " chunks before its samples";
            return std::nullopt;
        }
        const auto name = take (wav, 4);
        const auto size = takeSize (wav), start = wav.getPosition();
        if (name == "fmt ") found.format = take (wav, static_cast<int> (std::min<juce::int64> (size, longest_format)));
        if (name == "fact" && size >= 4) says_none = wav.readInt() == 0;
        if (name == "data" && ! found.format.empty())
        {
            found.data_bytes = long_size.value_or (size);
            found.data_start = start;
            if (! long_size && isUnknown (wav, static_cast<std::uint64_t> (size), start, says_none))
                found.data_bytes = wholeFrames (found.format, wav.getTotalLength() - start);
            break;
        }
        wav.setPosition (start + padded (size));
    }
    return found;
}

/// The header for JUCE. It is that of an RF64 file, which can state the size of any data.
std::string headerFor (const Chunks& chunks)
{
    constexpr auto unlimited = std::numeric_limits<juce::int64>::max() / 2;   // half of the range, because JUCE adds to the sizes
    juce::MemoryOutputStream out;
    out.write ("RF64", 4);
    out.writeInt (-1);
    out.write ("WAVEds64", 8);
    out.writeInt (28);
    out.writeInt64 (unlimited);   // the end of the stream ends the file
    out.writeInt64 (std::min (chunks.data_bytes.value_or (0), unlimited));
    out.writeInt64 (0);   // number of samples: not read
    out.writeInt (0);     // further sizes: none
    out.write ("fmt ", 4);
    out.writeInt (static_cast<int> (chunks.format.size()));
    out.write (chunks.format.data(), chunks.format.size());
    if (chunks.format.size() % 2 == 1) out.writeByte (0);
    if (chunks.data_bytes)
    {
        out.write ("data", 4);
        out.writeInt (0);
    }
    return { static_cast<const char*> (out.getData()), out.getDataSize() };
}

/// A header, followed by a part of a file.
class HeaderAndPart final : public juce::InputStream
{
public:
    HeaderAndPart (std::string h, std::unique_ptr<juce::InputStream> f, juce::int64 start, juce::int64 bytes)
        : header (std::move (h)), file (std::move (f)), part_start (start), header_bytes (static_cast<juce::int64> (header.size())),
          total (header_bytes + bytes)
    {
    }

    juce::int64 getTotalLength() override { return total; }
    bool isExhausted() override { return position >= total; }
    juce::int64 getPosition() override { return position; }
    bool setPosition (juce::int64 to) override
    {
        position = std::clamp (to, juce::int64 { 0 }, total);
        return true;
    }

    int read (void* into, int most) override
    {
        int done = 0;
        auto* bytes = static_cast<char*> (into);
        const auto room = [&] (juce::int64 available) { return static_cast<int> (std::clamp<juce::int64> (available, 0, most - done)); };
        if (const int now = room (header_bytes - position); now > 0)
        {
            std::memcpy (bytes, header.data() + position, static_cast<std::size_t> (now));
            done += now;
            position += now;
        }
        if (const int now = room (total - position); now > 0 && file->setPosition (part_start + position - header_bytes))
        {
            const int got = std::max (0, file->read (bytes + done, now));
            done += got;
            position += got;
        }
        return done;
    }

private:
    std::string header;
    std::unique_ptr<juce::InputStream> file;
    juce::int64 part_start, header_bytes, total, position = 0;
};
}   // namespace

namespace
{
bool hasDoubles (const std::string& format)
{
    const bool is_extensible = numberAt (format, 0) == 0xfffe && format.size() >= 26;
    return numberAt (format, is_extensible ? 24 : 0) == 3 && numberAt (format, 14) == 64;
}

void setNumber (std::string& format, std::size_t at, std::uint32_t value, std::size_t bytes)
{
    for (std::size_t i = 0; i < bytes; ++i)
        format[at + i] = static_cast<char> (static_cast<unsigned char> (value >> 8u * i));
}

/// The same samples as 32-bit floats, because JUCE does not read 64-bit ones. Rounding changes them by less than 1e-7 of their value. Without samples if
/// there are too many; the reader notices that from the claimed size.
std::unique_ptr<juce::InputStream> rounded (Chunks chunks, juce::InputStream& wav, juce::int64 bytes)
{
    const auto claimed = chunks.data_bytes.value_or (0) / 2;
    const auto in_file = bytes / 8;
    const auto count = static_cast<double> (in_file) > budgets().numbers ? 0 : in_file;
    auto& format = chunks.format;
    const auto rate = static_cast<std::uint32_t> (numberAt (format, 4)) | static_cast<std::uint32_t> (numberAt (format, 6)) << 16u;
    const auto frame = static_cast<std::uint32_t> (numberAt (format, 12)) / 2;
    setNumber (format, 8, rate * frame, 4);
    setNumber (format, 12, frame, 2);
    setNumber (format, 14, 32, 2);
    if (format.size() >= 20 && numberAt (format, 0) == 0xfffe) setNumber (format, 18, 32, 2);
    chunks.data_bytes = claimed;
    juce::MemoryOutputStream out;
    const auto header = headerFor (chunks);
    out.write (header.data(), header.size());
    wav.setPosition (chunks.data_start);
    for (juce::int64 i = 0; i < count; ++i)
        out.writeFloat (static_cast<float> (wav.readDouble()));
    return std::make_unique<juce::MemoryInputStream> (out.getMemoryBlock(), true);
}
}   // namespace

WavSamples samplesOnly (std::unique_ptr<juce::InputStream> wav)
{
    WavSamples none;
    const auto chunks = findChunks (*wav, none.why);
    if (chunks) none.why = whyNot (chunks->format);
    if (! none.why.empty()) return none;
    const auto in_file = std::max (juce::int64 { 0 }, wav->getTotalLength() - chunks->data_start);
    const auto bytes = std::clamp (chunks->data_bytes.value_or (0), juce::int64 { 0 }, in_file);
    if (hasDoubles (chunks->format))
    {
        auto floats = rounded (*chunks, *wav, bytes);
        return { std::move (floats), bytes / 2, {} };
    }
    return { std::make_unique<HeaderAndPart> (headerFor (*chunks), std::move (wav), chunks->data_start, bytes), bytes, {} };
}

}   // namespace tactus::host
