// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace tactus::host
{

/// The latest state of something, from one thread that has it to any that want to see it. A reader gets one that was as a
/// whole what the writer stored; the writer never waits, a reader looks again if it was stored over meanwhile.
///
/// A sequence lock (Boehm, "Can seqlocks get along with programming language memory models?", 2012): an odd number says
/// that somebody writes. The words are stored with release and loaded with acquire instead of fences, which a thread
/// sanitizer does not know: who sees a word of a later state sees its odd number too.
template <typename T>
class Snapshot
{
    static_assert (std::is_trivially_copyable_v<T> && sizeof (T) % sizeof (std::uint64_t) == 0);

public:
    explicit Snapshot (const T& first = {}) noexcept { store (first); }

    /// Of the value, the first `bytes` may be other ones than before. [writing thread]
    void store (const T& value, std::size_t bytes = sizeof (T)) noexcept
    {
        const auto n = sequence.load (std::memory_order_relaxed);
        sequence.store (n + 1, std::memory_order_relaxed);
        const auto* from = reinterpret_cast<const std::byte*> (&value);
        for (std::size_t i = 0; i * sizeof (std::uint64_t) < bytes; ++i)
        {
            std::uint64_t word = 0;
            std::memcpy (&word, from + i * sizeof word, sizeof word);
            words[i].store (word, std::memory_order_release);
        }
        sequence.store (n + 2, std::memory_order_release);
    }

    /// [any thread]
    T load() const noexcept
    {
        std::array<std::uint64_t, sizeof (T) / sizeof (std::uint64_t)> copy;
        for (;;)
        {
            const auto n = sequence.load (std::memory_order_acquire);
            for (std::size_t i = 0; i < copy.size(); ++i)
                copy[i] = words[i].load (std::memory_order_acquire);
            if (n % 2 == 0 && sequence.load (std::memory_order_relaxed) == n) break;
        }
        T value;
        std::memcpy (static_cast<void*> (&value), copy.data(), sizeof value);
        return value;
    }

private:
    std::atomic<std::uint64_t> sequence = 0;
    std::array<std::atomic<std::uint64_t>, sizeof (T) / sizeof (std::uint64_t)> words {};
};

}   // namespace tactus::host
