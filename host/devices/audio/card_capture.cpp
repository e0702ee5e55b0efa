// SPDX-License-Identifier: MIT
#include "card_capture.hpp"

#include <utility>

namespace tactus::host::audio
{

Result<std::unique_ptr<CardCapture>> CardCapture::create (const std::filesystem::path& path, double rate_hz, int channels)
{
    auto writer = WavWriter::create (path, rate_hz, static_cast<std::size_t> (channels), IfKilled::kept);
    if (! writer) return std::move (writer.error());
    return std::unique_ptr<CardCapture> (new CardCapture (std::move (*writer), rate_hz, channels));
}

void CardCapture::note (const float* const* channels, int count, int frames) noexcept
{
    for (int i = 0; i < frames; ++i)
    {
        const auto frame = ring.claim();
        for (std::size_t c = 0; c < frame.size(); ++c)
            frame[c] = c < static_cast<std::size_t> (count) ? static_cast<double> (channels[c][i]) : 0.0;
        ring.commit();
    }
}

Result<> CardCapture::drain()
{
    Result<> result;
    ring.drain ([&] (std::span<const double> frame) {
        if (has_failed) return;
        result = writer.frame (frame);
        has_failed = ! result;
        ++unflushed;
    });
    if (has_failed || unflushed <= frames_per_flush) return result;
    unflushed = 0;
    result = writer.flush();
    has_failed = ! result;
    return result;
}

Result<> CardCapture::commit()
{
    auto result = drain();
    if (has_failed) return result;
    return writer.commit();
}

}   // namespace tactus::host::audio
