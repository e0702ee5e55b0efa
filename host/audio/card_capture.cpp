// SPDX-License-Identifier: GPL-3.0-or-later
#include "card_capture.hpp"

#include <utility>

namespace tactus::host::audio
{

tl::expected<std::unique_ptr<CardCapture>, Error> CardCapture::create (const std::filesystem::path& path, double rate_hz, int channels)
{
    auto writer = WavWriter::create (path, rate_hz, static_cast<std::size_t> (channels));
    if (! writer) return tl::unexpected (std::move (writer.error()));
    return std::unique_ptr<CardCapture> (new CardCapture (std::move (*writer), rate_hz, channels));
}

void CardCapture::note (const float* const* channels, int count, int frames) noexcept
{
    for (int i = 0; i < frames; ++i)
    {
        const auto frame = ring.next();
        if (frame.empty()) continue;
        for (int c = 0; c < width; ++c)
            frame[static_cast<std::size_t> (c)] = c < count ? static_cast<double> (channels[c][i]) : 0.0;
        ring.push();
    }
}

tl::expected<void, Error> CardCapture::drain()
{
    tl::expected<void, Error> result;
    ring.drain ([&] (std::span<const double> frame)
                {
        if (has_failed) return;
        result = writer.frame (frame);
        has_failed = ! result; });
    return result;
}

tl::expected<void, Error> CardCapture::commit()
{
    auto result = drain();
    if (has_failed) return result;
    return writer.commit();
}

}   // namespace tactus::host::audio
