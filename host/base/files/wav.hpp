// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/file/atomic_file.hpp>
#include <tactus/kit/assets.hpp>
#include <tactus/text/result.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>

namespace tactus::host
{

/// Reads float samples unchanged (in our files they are SI values), and integer samples (8 to 32 bit) as -1…1. Skips the metadata.
/// Errors: wav/unreadable, wav/not_a_wav, wav/truncated, wav/too_many_channels.
[[nodiscard]] Result<Signal> readWav (const std::filesystem::path& path);

/// Writes 32-bit float samples, unscaled and unclipped, frame by frame. Beyond 4 GB the file becomes an RF64. The file
/// appears on commit(), or not at all; IfKilled says what becomes of it if the process is killed before.
///
/// A float is less precise than a double: 24 bits are kept, and values beyond 3.4e38 become inf.
class WavWriter
{
public:
    /// Refuses sample rates that a WAV cannot store (wav/sample_rate; only whole Hz are allowed) and bad channel counts
    /// (wav/channels; 1 to 1440 are allowed).
    [[nodiscard]] static Result<WavWriter> create (const std::filesystem::path& path, double sample_rate_hz, std::size_t channels,
                                                   IfKilled = IfKilled::removed);

    WavWriter (WavWriter&&) noexcept;
    WavWriter& operator= (WavWriter&&) noexcept;
    ~WavWriter();

    /// One sample per channel.
    [[nodiscard]] Result<> frame (std::span<const double> samples);

    /// Hands all frames so far, and a header that counts them, to the system; they then survive the end of the process.
    [[nodiscard]] Result<> flush();
    [[nodiscard]] Result<> commit();

private:
    struct Impl;
    explicit WavWriter (std::unique_ptr<Impl> opened) noexcept;

    std::unique_ptr<Impl> impl;
};

}   // namespace tactus::host
