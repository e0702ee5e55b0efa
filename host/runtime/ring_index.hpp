// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace tactus::host
{

/// Which slot of a ring is whose, between one thread that fills slots and one that empties them. Neither ever waits. The
/// slots themselves are their owner's. juce::AbstractFifo does the same, but would have all that runs in real time, and
/// its tests under a thread sanitizer, need JUCE.
class RingIndex
{
public:
    explicit RingIndex (std::size_t slots) noexcept : capacity (slots) {}

    /// The slot to fill next, then push(); nothing if all wait to be emptied. [filling thread]
    std::optional<std::size_t> next() const noexcept
    {
        const auto n = filled.load (std::memory_order_relaxed);
        if (n - emptied.load (std::memory_order_acquire) == capacity) return std::nullopt;
        return slotOf (n);
    }
    void push() noexcept { filled.store (filled.load (std::memory_order_relaxed) + 1, std::memory_order_release); }

    /// Hands over all slots that are filled, in order, and then takes them for empty. [emptying thread]
    template <typename F>
    void drain (F&& f)
    {
        const auto end = filled.load (std::memory_order_acquire);
        for (auto n = emptied.load (std::memory_order_relaxed); n != end; ++n)
            f (slotOf (n));
        emptied.store (end, std::memory_order_release);
    }

private:
    static constexpr std::size_t apart = 64;   // bytes, so that the threads do not share a cache line

    std::size_t slotOf (std::uint64_t n) const noexcept { return static_cast<std::size_t> (n % capacity); }

    std::uint64_t capacity;
    alignas (apart) std::atomic<std::uint64_t> filled = 0;
    alignas (apart) std::atomic<std::uint64_t> emptied = 0;
};

}   // namespace tactus::host
