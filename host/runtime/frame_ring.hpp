// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ring_index.hpp"

#include <span>
#include <vector>

namespace tactus::host
{

/// Frames of numbers from the tick thread to the one that writes them down. Neither ever waits: what does not fit is
/// lost, and counted.
class FrameRing
{
public:
    FrameRing (std::size_t width_, std::size_t frames) : width (width_), index (frames), values (width_ * frames) {}

    /// Where the next frame goes, or nothing if the ring is full; then push(). [tick thread]
    std::span<double> next() noexcept
    {
        if (const auto slot = index.next()) return frame (*slot);
        lost_frames.fetch_add (1, std::memory_order_relaxed);
        return {};
    }
    void push() noexcept { index.push(); }

    /// Hands over all frames there are. [writing thread]
    template <typename F>
    void drain (F&& f)
    {
        index.drain ([&] (std::size_t slot)
                     { f (frame (slot)); });
    }

    std::size_t lost() const noexcept { return lost_frames.load (std::memory_order_relaxed); }

private:
    std::size_t width;
    RingIndex index;
    std::vector<double> values;
    std::atomic<std::size_t> lost_frames { 0 };

    std::span<double> frame (std::size_t slot) noexcept { return std::span (values).subspan (slot * width, width); }
};

}   // namespace tactus::host
