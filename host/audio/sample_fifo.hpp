// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace tactus::host::audio
{

/// Frames of samples between one thread that adds them and one that takes them, in any number at a time. Neither ever
/// waits. Frames are counted from the first one there ever was, so that both know where they are.
class SampleFifo
{
public:
    SampleFifo (int lanes, std::size_t frames) : width (static_cast<std::size_t> (lanes)), capacity (frames), samples (width * frames) {}

    /// False if there is no room for it, and it is gone. [adding thread]
    bool push (std::span<const float> frame) noexcept
    {
        const auto n = added.load (std::memory_order_relaxed);
        if (n - taken.load (std::memory_order_acquire) == capacity) return false;
        std::copy_n (frame.data(), width, samples.data() + place (n));
        added.store (n + 1, std::memory_order_release);
        return true;
    }

    /// The oldest frames, as many as lie side by side; take() frees some of them. [taking thread]
    std::span<const float> front() const noexcept
    {
        const auto n = taken.load (std::memory_order_relaxed);
        const auto until_end = capacity - n % capacity;
        const auto frames = std::min (added.load (std::memory_order_acquire) - n, until_end);
        return { samples.data() + place (n), static_cast<std::size_t> (frames) * width };
    }
    void take (std::size_t frames) noexcept { taken.store (taken.load (std::memory_order_relaxed) + frames, std::memory_order_release); }

    std::uint64_t pushed() const noexcept { return added.load (std::memory_order_acquire); }    // [any thread]
    std::uint64_t removed() const noexcept { return taken.load (std::memory_order_acquire); }   // [any thread]
    std::size_t size() const noexcept
    {
        const auto out = removed();
        return static_cast<std::size_t> (pushed() - out);
    }
    int lanes() const noexcept { return static_cast<int> (width); }

private:
    static constexpr std::size_t apart = 64;   // bytes, so that the threads do not share a cache line

    std::size_t place (std::uint64_t n) const noexcept { return static_cast<std::size_t> (n % capacity) * width; }

    std::size_t width;
    std::uint64_t capacity;
    std::vector<float> samples;
    alignas (apart) std::atomic<std::uint64_t> added = 0;
    alignas (apart) std::atomic<std::uint64_t> taken = 0;
};

}   // namespace tactus::host::audio
