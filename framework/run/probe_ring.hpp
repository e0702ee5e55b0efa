// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/instances.hpp>
#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/plan/plan.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace tactus
{

/// True if a component belongs to a port, such as "drag.force.x" to "drag.force", "mix.in[0]" to "mix.in", or "finger[2].force" to
/// "finger.force".
inline bool isPartOf (std::string_view component, std::string_view port) noexcept
{
    const auto end = graph::covers (port, component);
    return end && (*end == component.size() || component[*end] == '.' || component[*end] == '[');
}

/// Hands samples of some ports from the tick thread to a reader. Neither side ever waits; samples that are not fetched in time
/// are lost.
class ProbeRing
{
public:
    static constexpr std::size_t most = 32;   ///< most components at a time

    struct Frame
    {
        std::uint64_t plan = 0;   ///< serial number of the plan that the taps belong to
        std::uint64_t tick = 0;
        std::size_t size = 0;
        std::array<double, most> values {};
    };

    /// Selects taps, by number, of the plan that is about to be submitted. Takes one frame every n ticks. The first selection allocates the ring,
    /// which needs 1 MB. [main thread]
    void select (std::span<const std::size_t> taps, std::uint32_t every)
    {
        if (! taps.empty() && ! frames) frames.emplace (capacity);
        for (std::size_t i = 0; i < taps.size() && i < most; ++i)
            selected[i].store (taps[i], std::memory_order_relaxed);
        interval.store (every, std::memory_order_relaxed);
        count.store (std::min (taps.size(), most), std::memory_order_release);
    }

    /// Samples the taps after a tick. [tick thread]
    void note (const Plan& plan, std::uint64_t tick) noexcept
    {
        const auto n = count.load (std::memory_order_acquire);
        if (n == 0 || tick % interval.load (std::memory_order_relaxed) != 0) return;
        if (const auto slot = frames->claim(); ! slot.empty()) fill (slot.front(), plan, tick, n);
        frames->commit();
    }

    /// Passes on all frames that have arrived. [one thread at a time, after select() or on its thread]
    template <typename F>
    void drain (F&& f)
    {
        if (frames) frames->drain ([&] (std::span<const Frame> frame) { f (frame.front()); });
    }

    std::uint64_t lost() const noexcept { return frames ? frames->lost() : 0; }   ///< frames that were not drained in time   [as drain]

private:
    static constexpr std::size_t capacity = 4096;   ///< in frames: one second at 4 kHz, in case the reader is busy for that long

    void fill (Frame& frame, const Plan& plan, std::uint64_t tick, std::size_t n) const noexcept
    {
        frame.plan = plan.serial();
        frame.tick = tick;
        frame.size = n;
        for (std::size_t i = 0; i < n; ++i)   // until the new plan takes over, the values belong to the previous plan, and the reader ignores the frames
            if (const auto tap = selected[i].load (std::memory_order_relaxed); tap < plan.taps().size()) frame.values[i] = *plan.taps()[tap].value;
    }

    std::array<std::atomic<std::size_t>, most> selected {};
    std::atomic<std::uint32_t> interval = 1;
    std::atomic<std::size_t> count = 0;
    std::optional<SpscRing<Frame>> frames;   // made before `count` first says that there are taps
};

}   // namespace tactus
