// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace tactus
{

/// The latest value of something, published by one thread and read by any number of threads. A reader always gets a value
/// that was stored as a whole. The writer never waits. A reader tries again only if the writer has gone on meanwhile, so a reader
/// that has interrupted the writer, such as a tick on the core of a thread with a lower priority, gets the value before.
///
/// Two copies with a sequence number (a "latch sequence counter" of the Linux kernel, Documentation/locking/seqlock.rst): while the
/// number is odd, the writer changes the first copy and readers use the second; while it is even, the other way round. Thread
/// sanitizers do not understand fences, so the words are stored with release and loaded with acquire instead (Boehm, "Can seqlocks get
/// along with programming language memory models?", 2012): a reader that sees a word of a later value also sees its number.
template <typename T>
class Snapshot
{
    static_assert (std::is_trivially_copyable_v<T> && sizeof (T) % sizeof (std::uint64_t) == 0);

public:
    explicit Snapshot (const T& first = {}) noexcept { store (first); }

    /// Only the first `bytes` of the value may differ from the last one stored. [writing thread]
    void store (const T& value, std::size_t bytes = sizeof (T)) noexcept
    {
        storeParts (value, [&] (auto part) { part (0, bytes); });
    }

    /// Stores parts of a value whose other parts are as they were last stored. `parts` calls its argument for each of them: where it begins
    /// in the value, and how long it is, in bytes; the length may be a std::integral_constant. Parts begin at multiples of 8 bytes.
    /// It is called once for each copy. [writing thread]
    template <typename Parts>
    void storeParts (const T& value, Parts&& parts) noexcept
    {
        const auto n = sequence.load (std::memory_order_relaxed);
        const auto* const from = reinterpret_cast<const std::byte*> (&value);
        sequence.store (n + 1, std::memory_order_release);
        parts (Part { copies[0], from });
        sequence.store (n + 2, std::memory_order_release);
        parts (Part { copies[1], from });
    }

    /// [any thread]
    T load() const noexcept
    {
        std::array<std::uint64_t, sizeof (T) / word_size> got;
        for (;;)
        {
            const auto n = sequence.load (std::memory_order_acquire);
            const auto& words = copies[n % 2];
            for (std::size_t i = 0; i < got.size(); ++i)
                got[i] = words[i].load (std::memory_order_acquire);
            if (sequence.load (std::memory_order_relaxed) == n) break;
        }
        T value;
        std::memcpy (static_cast<void*> (&value), got.data(), sizeof value);
        return value;
    }

private:
    static constexpr auto word_size = sizeof (std::uint64_t);
    using Words = std::array<std::atomic<std::uint64_t>, sizeof (T) / word_size>;

    /// Stores a part of a value.
    struct Part
    {
        Words& to;
        const std::byte* from;

        void operator() (std::size_t begin, std::size_t bytes) const noexcept
        {
            const auto end = std::min (begin / word_size + (bytes + word_size - 1) / word_size, to.size());
            for (auto i = begin / word_size; i < end; ++i)
                put (i);
        }

        /// Written without a loop, because a run publishes its status on every tick.
        template <std::size_t bytes>
        void operator() (std::size_t begin, std::integral_constant<std::size_t, bytes>) const noexcept
        {
            static_assert (bytes % word_size == 0);
            [&]<std::size_t... i> (std::index_sequence<i...>) noexcept { (put (begin / word_size + i), ...); }
            (std::make_index_sequence<bytes / word_size>());
        }

        void put (std::size_t i) const noexcept
        {
            std::uint64_t word = 0;
            std::memcpy (&word, from + i * word_size, word_size);
            to[i].store (word, std::memory_order_release);
        }
    };

    std::atomic<std::uint64_t> sequence = 0;
    std::array<Words, 2> copies {};
};

}   // namespace tactus
