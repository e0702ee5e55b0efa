// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "ring_index.hpp"

#include <framework/graph/instances.hpp>
#include <framework/plan/plan.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// True of "drag.force.x" and "drag.force", of "mix.in[0]" and "mix.in", of "finger[2].force" and "finger.force".
inline bool isPartOf (std::string_view component, std::string_view port) noexcept
{
    const auto end = graph::covers (port, component);
    return end && (*end == component.size() || component[*end] == '.' || component[*end] == '[');
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
        const auto slot = index.next();
        if (! slot) return;
        auto& frame = frames[*slot];
        frame.plan = &plan;
        frame.tick = tick;
        frame.size = n;
        for (std::size_t i = 0; i < n; ++i)   // of the plan before, until the new one has taken over, which nobody reads then
            if (const auto tap = selected[i].load (std::memory_order_relaxed); tap < plan.taps.size()) frame.values[i] = *plan.taps[tap].value;
        index.push();
    }

    /// Hands over all frames there are. [one thread at a time]
    template <typename F>
    void drain (F&& f)
    {
        index.drain ([&] (std::size_t slot)
                     { f (frames[slot]); });
    }

private:
    static constexpr std::size_t capacity = 4096;   ///< a second at 4 kHz, for a window that is busy so long

    std::array<std::atomic<std::size_t>, most> selected {};
    std::atomic<std::uint32_t> interval = 1;
    std::atomic<std::size_t> count = 0;
    RingIndex index { capacity };
    std::vector<Frame> frames = std::vector<Frame> (capacity);
};

}   // namespace tactus::host
