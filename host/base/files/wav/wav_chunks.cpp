// SPDX-License-Identifier: MIT
#include "wav_chunks.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr std::size_t shortest_format = 16, longest_format = 40;   // bytes; an extensible format takes 40

/// No program writes this many chunks; a file of empty chunks would take millions of reads.
constexpr int most_chunks = 1000;

constexpr std::uint64_t unknown_size = 0xffffffff;

std::string take (std::istream& in, std::uint64_t bytes)
{
    std::string taken (bytes, '\0');
    in.read (taken.data(), static_cast<std::streamsize> (bytes));
    taken.resize (static_cast<std::size_t> (in.gcount()));
    return taken;
}

/// A little-endian number; 0 where the file ends.
std::uint64_t takeNumber (std::istream& in, int bytes)
{
    std::uint64_t number = 0;
    for (int i = 0; const char c : take (in, static_cast<std::uint64_t> (bytes)))
        number |= std::uint64_t { static_cast<unsigned char> (c) } << 8 * i++;
    return number;
}

std::uint64_t padded (std::uint64_t bytes) { return bytes + (bytes & 1); }

unsigned numberAt (const std::string& format, std::size_t at)
{
    return static_cast<unsigned> (static_cast<unsigned char> (format[at]) | static_cast<unsigned char> (format[at + 1]) << 8);
}

/// Reads the chunk `fmt `. The bits of an extensible format are those of its container: the lowest of them may be 0.
void readFormat (const std::string& format, WavSamples& to)
{
    to.why = format.empty() ? "it has no chunk 'fmt ' before its samples" : "its chunk 'fmt ' is too short";
    if (format.size() < shortest_format) return;
    auto code = numberAt (format, 0);
    constexpr unsigned extensible = 0xfffe;
    if (code == extensible)
    {
        to.why = "its chunk 'fmt ' is too short for an extensible format";
        if (format.size() < longest_format) return;
        code = numberAt (format, 24);
    }
    to.channels = numberAt (format, 2);
    to.bits = numberAt (format, 14);
    to.rate_hz = numberAt (format, 4) + 65536.0 * numberAt (format, 6);
    to.is_float = code == 3;
    const auto bits = to.bits, frame = numberAt (format, 12);
    using Named = std::pair<unsigned, std::string_view>;
    static constexpr Named compressed[] { { 2, "ADPCM" }, { 6, "A-law" }, { 7, "mu-law" }, { 17, "IMA ADPCM" }, { 49, "GSM" }, { 80, "MPEG" }, { 85, "MP3" } };
    const bool fits = to.is_float ? bits == 32 || bits == 64 : bits == 8 || bits == 16 || bits == 24 || bits == 32;
    const auto* known = std::ranges::find (compressed, code, &Named::first);
    if (known != std::end (compressed))
        to.why = "its samples are compressed, as " + std::string (known->second);
    else if (code != 1 && code != 3)
        to.why = "its samples have a format that is not read, of the number " + std::to_string (code);
    else if (to.channels == 0)
        to.why = "its header says 0 channels";
    else if (to.rate_hz == 0.0)
        to.why = "its header says 0 samples per second";
    else if (! fits)
        to.why = "its samples are " + std::string (to.is_float ? "floats" : "integers") + " of " + std::to_string (bits) + " bits";
    else if (frame != 0 && frame != to.frameBytes())
        to.why = "its header says " + std::to_string (frame) + " bytes for " + std::to_string (to.channels) + " samples of " + std::to_string (bits) + " bits";
    else
        to.why.clear();
}

/// True if a chunk that may follow the samples begins here.
bool beginsAChunk (std::istream& wav)
{
    const auto name = take (wav, 4);
    wav.clear();
    static constexpr std::string_view known[] { "LIST", "id3 ", "ID3 ", "fact", "bext", "cue ", "smpl", "iXML", "PEAK", "JUNK", "_PMX" };
    return std::ranges::find (known, name) != std::end (known);
}

/// True if the size of the samples stands for an unknown one, as programs write it that stream, or that end before they know it: the largest number; just
/// below 2 GB (sox and arecord), if the file is shorter; or 0 before other bytes, unless the chunk `fact` says 0 as well.
bool isUnknown (std::istream& wav, std::uint64_t size, std::uint64_t in_file, bool says_none)
{
    constexpr std::uint64_t near_2_gb = 0x7fff0000, past_2_gb = 0x80000000;
    if (size == unknown_size) return true;
    if (size == 0) return ! says_none && ! beginsAChunk (wav);
    return size >= near_2_gb && size <= past_2_gb && size > in_file;
}
}   // namespace

WavSamples findWavSamples (std::istream& wav)
{
    WavSamples found;
    wav.seekg (0, std::ios::end);
    const auto length = static_cast<std::uint64_t> (std::max<std::streamoff> (0, wav.tellg()));
    wav.seekg (0);
    const auto kind = take (wav, 4);
    const bool is_rf64 = kind == "RF64" || kind == "BW64";   // two names of one layout
    found.why = kind.empty() ? "it is empty" : kind == "RIFX" ? "its numbers are big-endian (RIFX)"
                                                              : "it does not begin with 'RIFF' and 'WAVE'";
    if (! is_rf64 && kind != "RIFF") return found;
    // The claimed size of the file ends the search. A program that streams cannot go back to write it, and leaves 0 or the largest number.
    auto size = takeNumber (wav, 4);
    std::uint64_t end = is_rf64 || size == 0 || size == unknown_size ? length : std::min (length, size + 8), long_size = 0;
    if (take (wav, 4) != "WAVE") return found;
    if (is_rf64)
    {
        found.why = "it has no chunk 'ds64', which holds its size";
        if (take (wav, 4) != "ds64") return found;
        size = takeNumber (wav, 4);
        if (size < 28) return found;
        end = std::min (length, takeNumber (wav, 8)) + 8;
        long_size = takeNumber (wav, 8);
        wav.seekg (static_cast<std::streamoff> (20 + padded (size)));
    }

    std::string format;
    bool says_none = false;
    for (int chunk = 0;; ++chunk)
    {
        const auto at = static_cast<std::uint64_t> (std::max<std::streamoff> (0, wav.tellg()));
        if (! wav || at >= end || at + 8 > length) break;
        if (chunk == most_chunks)
        {
            found.why = "it has more than " + std::to_string (most_chunks) + " chunks before its samples";
            return found;
        }
        const auto name = take (wav, 4);
        size = takeNumber (wav, 4);
        found.start = at + 8;
        if (name == "data" && ! format.empty())
        {
            readFormat (format, found);
            const auto in_file = length - found.start, frame = found.frameBytes();
            found.claimed = is_rf64 ? long_size : size;
            if (! is_rf64 && isUnknown (wav, size, in_file, says_none)) found.claimed = frame > 0 ? in_file / frame * frame : 0;
            found.present = std::min (found.claimed, in_file);
            return found;
        }
        if (name == "fmt ") format = take (wav, std::min<std::uint64_t> (size, longest_format));
        if (name == "fact" && size >= 4) says_none = takeNumber (wav, 4) == 0;
        wav.clear();
        wav.seekg (static_cast<std::streamoff> (found.start + padded (size)));
    }
    readFormat (format, found);
    return found;
}

}   // namespace tactus::host
