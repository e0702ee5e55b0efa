// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tactus::host
{

/// Words from the tick thread to the one that writes them down, in pieces of any length that arrive whole or not at all.
/// Neither thread ever waits.
class WordRing
{
public:
    explicit WordRing (std::size_t capacity) : words (capacity + 1) {}

    /// Adds to the piece. [tick thread]
    void put (std::uint64_t word) noexcept
    {
        const auto next = after (end);
        if (next == first.load (std::memory_order_acquire)) full = true;
        if (full) return;
        words[end] = word;
        end = next;
    }

    /// Hands the piece over and begins another one. False if there was no room for it, and it is gone. [tick thread]
    bool commit() noexcept
    {
        if (full)
        {
            discard();
            return false;
        }
        last.store (end, std::memory_order_release);
        return true;
    }

    /// Begins the piece anew. [tick thread]
    void discard() noexcept
    {
        end = last.load (std::memory_order_relaxed);
        full = false;
    }

    /// True while there is a piece, or the rest of one. [writing thread]
    bool hasMore() const noexcept { return begin != last.load (std::memory_order_acquire); }

    /// The next word, of which there must be one. [writing thread]
    std::uint64_t take() noexcept
    {
        const auto word = words[begin];
        begin = after (begin);
        first.store (begin, std::memory_order_release);
        return word;
    }

private:
    std::size_t after (std::size_t i) const noexcept { return i + 1 < words.size() ? i + 1 : 0; }

    std::vector<std::uint64_t> words;
    std::atomic<std::size_t> first = 0, last = 0;   // what is handed over

    std::size_t end = 0;     // of the piece         [tick thread]
    bool full = false;       // while it was made    [tick thread]
    std::size_t begin = 0;   // as first             [writing thread]
};

}   // namespace tactus::host
