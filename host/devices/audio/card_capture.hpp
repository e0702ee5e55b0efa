// SPDX-License-Identifier: MIT
#pragma once

#include <host/base/files/wav.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>

#include <filesystem>
#include <optional>

namespace tactus::host::audio
{

/// Records the output of a card as a WAV file of 32-bit floats, which appears when the recording is complete. If the process is
/// killed, the recording up to its last second is kept (IfKilled::kept). If writing fails, the run continues.
class CardCapture
{
public:
    static constexpr double room_s = 2.0;    ///< capacity for samples that wait to be written, in s
    static constexpr double flush_s = 0.5;   ///< time between two flushes to the file, in s

    /// Ids: those of WavWriter::create. [main thread]
    static Result<std::unique_ptr<CardCapture>> create (const std::filesystem::path&, double rate_hz, int channels);

    /// [audio thread]
    void note (const float* const* channels, int count, int frames) noexcept;

    /// Writes the waiting samples; call it many times a second. Returns the first error once, then writes nothing more.
    [[nodiscard]] Result<> drain();    // [main thread]
    [[nodiscard]] Result<> commit();   // [main thread, when no more blocks arrive]

    std::size_t lost() const noexcept { return ring.lost(); }   ///< frames dropped for lack of room [any thread]

private:
    CardCapture (WavWriter w, double rate_hz, int channels)
        : writer (std::move (w)), frames_per_flush (static_cast<std::size_t> (flush_s * rate_hz)),
          ring (static_cast<std::size_t> (room_s * rate_hz), static_cast<std::size_t> (channels))
    {
    }

    WavWriter writer;
    std::size_t frames_per_flush, unflushed = 0;
    SpscRing<double> ring;
    bool has_failed = false;
};

}   // namespace tactus::host::audio
