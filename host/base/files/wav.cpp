// SPDX-License-Identifier: GPL-3.0-or-later
#include "wav.hpp"
#include <host/base/files/wav/wav_header.hpp>
#include <host/base/files/wav/wav_samples.hpp>

#include <tactus/file/atomic_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/number_text.hpp>

#include <juce_audio_formats/juce_audio_formats.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>

namespace tactus::host
{

namespace
{
/// JUCE's reader takes frames from a buffer of this size; if a frame is larger, reading never ends.
constexpr std::size_t largest_frame_bytes = 480 * 3 * 4;
constexpr std::size_t most_channels = largest_frame_bytes / sizeof (float);

constexpr std::size_t frames_per_block = 1024;

bool isKnown (const juce::AudioFormatReader& reader)
{
    const auto bits = reader.bitsPerSample;
    return bits == 32 || (! reader.usesFloatingPointData && (bits == 8 || bits == 16 || bits == 24));
}

/// Converts a sample. The reader returns the bits of a float, or a 32-bit integer regardless of the integer size in the file.
double sampleFrom (int raw, const juce::AudioFormatReader& reader)
{
    return reader.usesFloatingPointData ? double { std::bit_cast<float> (raw) } : std::ldexp (raw, -31);
}
}   // namespace

Result<Signal> readWav (const std::filesystem::path& path)
{
    if (const auto why = whyUnreadable (path); ! why.empty()) return Message::error ("wav/unreadable", path.string(), why, "check the path");
    const auto full_path = std::filesystem::absolute (path).string();
    std::unique_ptr<juce::InputStream> stream = juce::File (juce::String::fromUTF8 (full_path.c_str())).createInputStream();
    if (stream == nullptr)
        return Message::error ("wav/unreadable", path.string(), "there is no such file, or it is not readable",
                               "check the path and the permissions");

    auto samples = samplesOnly (std::move (stream));
    std::unique_ptr<juce::AudioFormatReader> reader;
    if (samples.stream != nullptr)
        reader.reset (juce::WavAudioFormat().createReaderFor (samples.stream.release(), true));

    if (reader == nullptr || ! isKnown (*reader))
        return Message::error ("wav/not_a_wav", path.string(),
                               "it is not a supported WAV file" + (samples.why.empty() ? "" : ": " + samples.why),
                               "save it as WAV, 32- or 64-bit float or 8-, 16-, 24- or 32-bit integer");

    const std::size_t bytes_per_frame = reader->numChannels * reader->bitsPerSample / 8;
    if (bytes_per_frame > largest_frame_bytes)
        return Message::error ("wav/too_many_channels", path.string(), "it has too many channels: " + std::to_string (reader->numChannels),
                               "save it with fewer channels");

    // Checked before memory is allocated, because a header may claim any size.
    if (reader->lengthInSamples < 0 || reader->lengthInSamples > samples.bytes / static_cast<juce::int64> (bytes_per_frame))
        return Message::error ("wav/truncated", path.string(), "its header declares more samples than the file contains",
                               "create the file again; writing it was interrupted");

    const auto frames = static_cast<std::size_t> (reader->lengthInSamples);
    const std::size_t channels = reader->numChannels;
    if (const auto count = static_cast<double> (frames) * static_cast<double> (channels); count > budgets().numbers)
    {
        const auto over = overBudget ("wav/too_large", &Budgets::numbers, "it", count, "save a part of it");
        return Message::error (over.id, path.string(), over.text, over.remedy);
    }
    Signal recording { .rate_hz = reader->sampleRate, .channels = std::vector (channels, std::vector<double> (frames)) };

    std::vector<std::vector<int>> block (channels, std::vector<int> (frames_per_block));
    std::vector<int*> pointers;
    for (auto& channel : block)
        pointers.push_back (channel.data());

    for (std::size_t done = 0; done < frames; done += frames_per_block)
    {
        const auto now = std::min (frames_per_block, frames - done);
        if (! reader->read (pointers.data(), static_cast<int> (channels), static_cast<juce::int64> (done),
                            static_cast<int> (now), false))
            return Message::error ("wav/unreadable", path.string(), "reading failed before the end of the file", "check the disk");

        for (std::size_t channel = 0; channel < channels; ++channel)
            for (std::size_t i = 0; i < now; ++i)
                recording.channels[channel][done + i] = sampleFrom (block[channel][i], *reader);
    }
    return recording;
}

struct WavWriter::Impl
{
    AtomicFile file;
    double rate_hz;
    std::size_t channels;
    std::uint64_t frames = 0;
    std::string block {};

    Result<> write (const std::string& bytes)
    {
        errno = 0;
        if (! file.stream().write (bytes.data(), static_cast<std::streamsize> (bytes.size()))) return file.writeError();
        return {};
    }

    Result<> writeBlock()
    {
        auto written = write (block);
        block.clear();
        return written;
    }

    /// Writes what is left, and the header with the sizes so far.
    Result<> complete()
    {
        if (auto written = writeBlock(); ! written) return written;
        auto& stream = file.stream();
        stream.seekp (0);
        if (auto written = write (wavHeader (rate_hz, channels, frames)); ! written) return written;
        if (! stream.seekp (0, std::ios::end)) return file.writeError();
        return {};
    }
};

Result<WavWriter> WavWriter::create (const std::filesystem::path& path, double sample_rate_hz, std::size_t channels, IfKilled if_killed)
{
    if (channels == 0 || channels > most_channels)
        return Message::error ("wav/channels", path.string(), "a WAV file cannot have " + std::to_string (channels) + " channels",
                               "record 1 to " + std::to_string (most_channels) + " components, or write a CSV");

    // The header stores the sample rate and the bytes per second as 32-bit integers.
    const auto highest = std::floor (std::numeric_limits<int>::max() / static_cast<double> (channels * sizeof (float)));
    if (! (sample_rate_hz >= 1.0 && sample_rate_hz <= highest) || std::floor (sample_rate_hz) != sample_rate_hz)
        return Message::error ("wav/sample_rate", path.string(), "a WAV file cannot have a sample rate of " + roundedText (sample_rate_hz, 12) + " Hz",
                               "choose a rate in whole Hz, or write a CSV");

    auto file = AtomicFile::create (path, if_killed);
    if (! file)
        return file.error();
    if (file->stream().tellp() < 0)
        return Message::error ("output/unwritable", path.string(),
                               "cannot be written: the header of a WAV is completed at the end, which a pipe does not allow",
                               "write to a file");

    auto impl = std::make_unique<Impl> (Impl { std::move (*file), sample_rate_hz, channels });
    if (auto written = impl->write (wavHeader (sample_rate_hz, channels, 0)); ! written) return written.error();
    return WavWriter (std::move (impl));
}

WavWriter::WavWriter (std::unique_ptr<Impl> opened) noexcept : impl (std::move (opened)) {}
WavWriter::WavWriter (WavWriter&&) noexcept = default;
WavWriter& WavWriter::operator= (WavWriter&&) noexcept = default;
WavWriter::~WavWriter() = default;

Result<> WavWriter::frame (std::span<const double> samples)
{
    if (samples.size() != impl->channels)
        return Message::error ("wav/channels", "the frame to write",
                               "it has " + std::to_string (samples.size()) + " samples for " + std::to_string (impl->channels) + " channels",
                               "give one sample per channel");

    for (const double s : samples)
        appendInteger (impl->block, std::bit_cast<std::uint32_t> (static_cast<float> (s)), 4);

    if (++impl->frames % frames_per_block == 0)
        return impl->writeBlock();
    return {};
}

Result<> WavWriter::flush()
{
    if (auto written = impl->complete(); ! written)
        return written;
    errno = 0;
    if (! impl->file.stream().flush())
        return impl->file.writeError();
    return {};
}

Result<> WavWriter::commit()
{
    if (auto written = impl->complete(); ! written)
        return written;
    return impl->file.commit();
}

}   // namespace tactus::host
