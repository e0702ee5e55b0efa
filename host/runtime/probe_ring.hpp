// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/plan/plan.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include <juce_core/juce_core.h>

namespace tactus::host
{

/// True of "drag.force.x" and "drag.force", of "mix.in[0]" and "mix.in".
inline bool isPartOf (std::string_view component, std::string_view port) noexcept
{
    return component.starts_with (port) && (component.size() == port.size() || component[port.size()] == '.' || component[port.size()] == '[');
}

/// What stands on some ports now and then, from the tick thread to those who want to see it. Neither ever waits: what
/// nobody fetches in time is lost.
class ProbeRing
{
public:
    static constexpr std::size_t most = 32;   ///< components at a time

    struct Frame
    {
        const Plan* plan = nullptr;   ///< never looked into: only says whose taps these are
        std::uint64_t tick = 0;
        std::size_t size = 0;
        std::array<double, most> values {};
    };

    /// These taps, by their numbers, of the plan that is about to be submitted; one frame in so many ticks. [main thread]
    void select (std::span<const std::size_t> taps, std::uint32_t every) noexcept
    {
        for (std::size_t i = 0; i < taps.size() && i < most; ++i)
            selected[i].store (taps[i], std::memory_order_relaxed);
        interval.store (every, std::memory_order_relaxed);
        count.store (std::min (taps.size(), most), std::memory_order_release);
    }

    /// Notes what stands there after a tick. [tick thread]
    void note (const Plan& plan, std::uint64_t tick) noexcept
    {
        const auto n = count.load (std::memory_order_acquire);
        if (n == 0 || tick % interval.load (std::memory_order_relaxed) != 0) return;
        int start = 0, size = 0, start2 = 0, size2 = 0;
        fifo.prepareToWrite (1, start, size, start2, size2);
        if (size + size2 == 0) return;
        auto& frame = frames[static_cast<std::size_t> (size > 0 ? start : start2)];
        frame.plan = &plan;
        frame.tick = tick;
        frame.size = n;
        for (std::size_t i = 0; i < n; ++i)   // of the plan before, until the new one has taken over, which nobody reads then
            if (const auto tap = selected[i].load (std::memory_order_relaxed); tap < plan.taps.size()) frame.values[i] = *plan.taps[tap].value;
        fifo.finishedWrite (1);
    }

    /// Hands over all frames there are. [main thread]
    template <typename F>
    void drain (F&& f)
    {
        int start = 0, size = 0, start2 = 0, size2 = 0;
        fifo.prepareToRead (fifo.getNumReady(), start, size, start2, size2);
        for (int i = 0; i < size; ++i)
            f (frames[static_cast<std::size_t> (start + i)]);
        for (int i = 0; i < size2; ++i)
            f (frames[static_cast<std::size_t> (start2 + i)]);
        fifo.finishedRead (size + size2);
    }

private:
    static constexpr int capacity = 1024;

    std::array<std::atomic<std::size_t>, most> selected {};
    std::atomic<std::uint32_t> interval = 1;
    std::atomic<std::size_t> count = 0;
    juce::AbstractFifo fifo { capacity };
    std::vector<Frame> frames = std::vector<Frame> (capacity);
};

}   // namespace tactus::host
