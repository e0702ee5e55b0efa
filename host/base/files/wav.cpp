// SPDX-License-Identifier: MIT
#include "wav.hpp"
#include <host/base/files/wav/wav_chunks.hpp>
#include <host/base/files/wav/wav_header.hpp>

#include <tactus/file/atomic_file.hpp>
#include <tactus/file/text_file.hpp>
#include <tactus/text/budget.hpp>
#include <tactus/text/number_text.hpp>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <string>
#include <utility>

namespace tactus::host
{

namespace
{
constexpr std::size_t most_channels = 1440, frames_per_block = 1024;

/// The sample whose bytes begin here.
double sampleAt (const char* bytes, const WavSamples& format)
{
    std::uint64_t raw = 0;
    for (unsigned i = 0; i < format.bits / 8; ++i)
        raw |= std::uint64_t { static_cast<unsigned char> (bytes[i]) } << 8 * i;
    if (format.is_float) return format.bits == 64 ? std::bit_cast<double> (raw) : double { std::bit_cast<float> (static_cast<std::uint32_t> (raw)) };
    if (format.bits == 8) raw ^= 0x80;   // 8 bits have no sign: 128 is 0
    return std::ldexp (std::bit_cast<std::int32_t> (static_cast<std::uint32_t> (raw << (32 - format.bits))), -31);
}
}   // namespace

Result<Signal> readWav (const std::filesystem::path& path)
{
    if (const auto why = whyUnreadable (path); ! why.empty()) return Message::error ("wav/unreadable", path.string(), why, "check the path");
    std::ifstream file (path, std::ios::binary);
    if (! file)
        return Message::error ("wav/unreadable", path.string(), "there is no such file, or it is not readable",
                               "check the path and the permissions");

    const auto samples = findWavSamples (file);
    if (! samples.why.empty())
        return Message::error ("wav/not_a_wav", path.string(), "it is not a supported WAV file: " + samples.why,
                               "save it as WAV, 32- or 64-bit float or 8-, 16-, 24- or 32-bit integer");

    const std::size_t channels = samples.channels;
    if (channels > most_channels)
        return Message::error ("wav/too_many_channels", path.string(), "it has too many channels: " + std::to_string (channels),
                               "save it with fewer channels");

    // Checked before memory is allocated, because a header may claim any size.
    const auto frame_bytes = samples.frameBytes();
    if (samples.claimed / frame_bytes > samples.present / frame_bytes)
        return Message::error ("wav/truncated", path.string(), "its header declares more samples than the file contains",
                               "create the file again; writing it was interrupted");

    const auto frames = static_cast<std::size_t> (samples.present / frame_bytes);
    if (const auto count = static_cast<double> (frames) * static_cast<double> (channels); count > budgets().numbers)
    {
        const auto over = overBudget ("wav/too_large", &Budgets::numbers, "it", count, "save a part of it");
        return Message::error (over.id, path.string(), over.text, over.remedy);
    }
    Signal recording { .rate_hz = samples.rate_hz, .channels = std::vector (channels, std::vector<double> (frames)) };

    file.clear();
    file.seekg (static_cast<std::streamoff> (samples.start));
    std::string block;
    for (std::size_t done = 0; done < frames; done += frames_per_block)
    {
        const auto now = std::min (frames_per_block, frames - done);
        block.resize (now * frame_bytes);
        if (! file.read (block.data(), static_cast<std::streamsize> (block.size())))
            return Message::error ("wav/unreadable", path.string(), "reading failed before the end of the file", "check the disk");
        const auto* bytes = block.data();
        for (std::size_t i = 0; i < now; ++i)
            for (std::size_t channel = 0; channel < channels; ++channel, bytes += samples.bits / 8)
                recording.channels[channel][done + i] = sampleAt (bytes, samples);
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
