// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/profile.hpp>

#include <tactus/node/device.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

namespace tactus::host::hid
{

/// Turns signals with one value per tick into blocks of frames at the rate of a stream. Interpolates linearly between ticks, so
/// there is no delay other than that of a block. Frequencies above half the lower of the two rates fold back. Allocates nothing
/// after construction.
class StreamFeed
{
public:
    /// Its channels are the device's signals from `first_channel` onwards.
    StreamFeed (const Stream& s, std::size_t first_channel)
        : frames (s.frames), channels (s.channels.size()), first (first_channel), rate_hz (s.rate), before (channels), block (frames * channels)
    {
    }

    void prepare (double dt_s) noexcept   // [main thread]
    {
        step = rate_hz > 0.0 ? 1.0 / (rate_hz * dt_s) : 1.0;
        next = step;
        filled = 0;
        std::ranges::fill (before, 0.0);
    }

    /// Processes one tick. Calls `full` with each full block: frame by frame, one sample per channel.
    template <typename F>
    void tick (const Channels& signals, F&& full) noexcept
    {
        for (; next <= 1.0; next += step)
        {
            for (std::size_t c = 0; c < channels; ++c)
                block[filled * channels + c] = static_cast<float> (before[c] + next * (at (signals, c) - before[c]));
            if (++filled < frames) continue;
            filled = 0;
            full (std::span<const float> (block));
        }
        next -= 1.0;
        for (std::size_t c = 0; c < channels; ++c)
            before[c] = at (signals, c);
    }

private:
    double at (const Channels& signals, std::size_t c) const noexcept { return signals[static_cast<int> (first + c)]; }

    std::size_t frames, channels, first;
    double rate_hz, step = 1.0, next = 1.0;   // step: ticks from frame to frame; next: ticks from the last tick to the next frame
    std::size_t filled = 0;
    std::vector<double> before;
    std::vector<float> block;
};

}   // namespace tactus::host::hid
