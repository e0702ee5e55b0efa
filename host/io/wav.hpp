// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/assets.hpp>
#include <host/io/error.hpp>

#include <tl/expected.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

namespace tactus::host
{

/// Reads 32-bit float samples as they are, which in files of ours are SI values, and integer samples (8 to 32 bit)
/// as -1…1. Ids of errors: wav/unreadable, wav/not_a_wav, wav/truncated, wav/too_many_channels.
[[nodiscard]] tl::expected<Signal, Error> readWav (const std::filesystem::path& path);

/// Writes 32-bit float samples, unscaled and unclipped, frame by frame; over 4 GB the file becomes an RF64.
/// The file appears on commit() or not at all.
///
/// A double loses what a float cannot hold: 24 bits of precision are kept, and what is beyond 3.4e38 becomes inf.
class WavWriter
{
public:
    /// Refuses rates a WAV cannot hold (wav/sample_rate: whole Hz only) and channel counts (wav/channels: 1 to 1440).
    [[nodiscard]] static tl::expected<WavWriter, Error> create (const std::filesystem::path& path, double sample_rate_hz, std::size_t channels);

    WavWriter (WavWriter&&) noexcept;
    WavWriter& operator= (WavWriter&&) noexcept;
    ~WavWriter();

    /// One sample of each channel.
    [[nodiscard]] tl::expected<void, Error> frame (std::span<const double> samples);
    [[nodiscard]] tl::expected<void, Error> commit();

private:
    struct Impl;
    explicit WavWriter (std::unique_ptr<Impl> opened) noexcept;

    std::unique_ptr<Impl> impl;   // keeps JUCE out of this header
};

}   // namespace tactus::host
