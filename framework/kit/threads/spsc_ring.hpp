// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace tactus
{

/// A ring buffer between one producer thread and one consumer thread. Wait-free on both sides; after construction nothing
/// is allocated. (juce::AbstractFifo does the same, but the tick thread and its thread-sanitizer tests need to build
/// without JUCE.)
///
/// The ring holds frames of `width` values each. The producer claims frames, fills them and commits them as one batch: the
/// batch arrives whole, or not at all if there is no room for it. A batch that does not arrive is counted as lost.
///
///     if (const auto frame = ring.claim(); ! frame.empty()) fill (frame);
///     ring.commit();
template <typename T>
class SpscRing
{
public:
    /// Room for `frames` frames. Each value starts as a copy of `prototype`, so a T that owns memory allocates it here and not later.
    explicit SpscRing (std::size_t frames, std::size_t width = 1, const T& prototype = {})
        : capacity (frames), per_frame (width), values (frames * width, prototype) {}

    //==========================================================================
    // [producer thread]

    /// Adds a frame to the batch and returns it, with the values of an earlier lap. Empty if there is no room for it; the
    /// batch is then lost.
    std::span<T> claim() noexcept
    {
        full = full || written - taken.load (std::memory_order_acquire) == capacity;
        return full ? std::span<T> {} : frame (written++);
    }

    /// Adds a frame of one value to the batch.
    void put (const T& value) noexcept
    {
        if (const auto slot = claim(); ! slot.empty()) slot.front() = value;
    }

    /// Commits a batch of one frame, given as `width` values. False if there was no room for it.
    bool push (std::span<const T> from) noexcept
    {
        if (const auto slot = claim(); ! slot.empty()) std::ranges::copy (from, slot.begin());
        return commit();
    }

    /// Hands the batch over and begins the next one. False if there was no room for all of it; then none of it arrives.
    bool commit() noexcept
    {
        if (full)
        {
            discard();
            lost_batches.fetch_add (1, std::memory_order_relaxed);
            return false;
        }
        committed.store (written, std::memory_order_release);
        return true;
    }

    /// Drops the batch and begins the next one.
    void discard() noexcept
    {
        written = committed.load (std::memory_order_relaxed);
        full = false;
    }

    //==========================================================================
    // [consumer thread]

    /// Passes all committed frames to `f` in order, each as a span, and then frees them.
    template <typename F>
    void drain (F&& f)
    {
        const auto end = committed.load (std::memory_order_acquire);
        for (auto n = taken.load (std::memory_order_relaxed); n != end; ++n)
            f (frame (n));
        taken.store (end, std::memory_order_release);
    }

    /// The oldest frames, as many as are contiguous in memory. They stay valid until take() frees them.
    std::span<const T> front() const noexcept
    {
        const auto n = taken.load (std::memory_order_relaxed);
        const auto frames = std::min (committed.load (std::memory_order_acquire) - n, capacity - n % capacity);
        return std::span (values).subspan (place (n), static_cast<std::size_t> (frames) * per_frame);
    }

    /// Frees the oldest frames.
    void take (std::size_t frames) noexcept { taken.store (taken.load (std::memory_order_relaxed) + frames, std::memory_order_release); }

    /// Takes the oldest frame of a ring of width 1. There must be one.
    T pop() noexcept
    {
        T value = front().front();
        take (1);
        return value;
    }

    //==========================================================================
    // [any thread]

    std::size_t size() const noexcept   ///< frames that are committed and not taken yet
    {
        const auto out = removed();
        return static_cast<std::size_t> (pushed() - out);
    }
    std::uint64_t pushed() const noexcept { return committed.load (std::memory_order_acquire); }   ///< frames committed since construction
    std::uint64_t removed() const noexcept { return taken.load (std::memory_order_acquire); }      ///< frames taken since construction
    std::size_t lost() const noexcept { return lost_batches.load (std::memory_order_relaxed); }
    std::size_t width() const noexcept { return per_frame; }

private:
    static constexpr std::size_t cache_line = 64;   // in bytes; the two threads must not share a cache line

    std::size_t place (std::uint64_t n) const noexcept { return static_cast<std::size_t> (n % capacity) * per_frame; }
    std::span<T> frame (std::uint64_t n) noexcept { return std::span (values).subspan (place (n), per_frame); }

    std::uint64_t capacity;   // in frames
    std::size_t per_frame;
    std::vector<T> values;

    alignas (cache_line) std::atomic<std::uint64_t> committed = 0;
    std::uint64_t written = 0;   // number of frames committed or in the current batch   [producer thread]
    bool full = false;           // the current batch does not fit                [producer thread]
    std::atomic<std::size_t> lost_batches = 0;

    alignas (cache_line) std::atomic<std::uint64_t> taken = 0;
};

}   // namespace tactus
