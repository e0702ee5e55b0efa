// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <span>
#include <vector>

#include <juce_core/juce_core.h>

namespace tactus::host
{

/// Frames of numbers from the tick thread to the one that writes them down. Neither ever waits: what does not fit is
/// lost, and counted.
class FrameRing
{
public:
    FrameRing (std::size_t width_, int frames) : width (width_), fifo (frames), values (width_ * static_cast<std::size_t> (frames)) {}

    /// Where the next frame goes, or nothing if the ring is full; then push(). [tick thread]
    std::span<double> next() noexcept
    {
        int start = 0, size = 0, start2 = 0, size2 = 0;
        fifo.prepareToWrite (1, start, size, start2, size2);
        if (size + size2 == 0)
        {
            lost_frames.fetch_add (1, std::memory_order_relaxed);
            return {};
        }
        return frame (size > 0 ? start : start2);
    }
    void push() noexcept { fifo.finishedWrite (1); }

    /// Hands over all frames there are. [writing thread]
    template <typename F>
    void drain (F&& f)
    {
        int start = 0, size = 0, start2 = 0, size2 = 0;
        fifo.prepareToRead (fifo.getNumReady(), start, size, start2, size2);
        for (int i = 0; i < size; ++i)
            f (frame (start + i));
        for (int i = 0; i < size2; ++i)
            f (frame (start2 + i));
        fifo.finishedRead (size + size2);
    }

    std::size_t lost() const noexcept { return lost_frames.load (std::memory_order_relaxed); }

private:
    std::size_t width;
    juce::AbstractFifo fifo;
    std::vector<double> values;
    std::atomic<std::size_t> lost_frames { 0 };

    std::span<double> frame (int i) noexcept { return std::span (values).subspan (static_cast<std::size_t> (i) * width, width); }
};

}   // namespace tactus::host
