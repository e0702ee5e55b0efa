// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/io/wav.hpp>
#include <host/runtime/frame_ring.hpp>

#include <filesystem>
#include <optional>

namespace tactus::host::audio
{

/// What a card is given, as a WAV of 32-bit floats that appears when all is over. A run goes on where writing cannot.
class CardCapture
{
public:
    static constexpr double room_s = 2.0;   ///< of samples that wait to be written

    /// Ids as of WavWriter::create. [main thread]
    static tl::expected<std::unique_ptr<CardCapture>, Error> create (const std::filesystem::path&, double rate_hz, int channels);

    /// [audio thread]
    void note (const float* const* channels, int count, int frames) noexcept;

    /// Writes down what there is: many times a second. The first error is told once, and then nothing more is written.
    [[nodiscard]] tl::expected<void, Error> drain();    // [main thread]
    [[nodiscard]] tl::expected<void, Error> commit();   // [main thread, when no block comes]

    std::size_t lost() const noexcept { return ring.lost(); }   ///< frames there was no room for [any thread]

private:
    CardCapture (WavWriter w, double rate_hz, int channels) : writer (std::move (w)), width (channels), ring (static_cast<std::size_t> (channels), static_cast<std::size_t> (room_s * rate_hz)) {}

    WavWriter writer;
    int width;
    FrameRing ring;
    bool has_failed = false;
};

}   // namespace tactus::host::audio
