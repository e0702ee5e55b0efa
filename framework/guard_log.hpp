// SPDX-License-Identifier: MIT
#pragma once

#include "guard.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <vector>

namespace tactus
{

/// The latest stops of all guards of an engine. One thread notes them, any may read meanwhile: no locks, no waiting, and
/// nothing is allocated by noting. As in a sequence lock, words are stored with release and loaded with acquire, so that who
/// sees a word of a later entry sees how far the count has come too.
class GuardLog
{
public:
    static constexpr std::size_t most = 64;

    struct Entry
    {
        std::uint64_t tick = 0;
        std::string_view role {};   ///< lives as long as the engine
        Guard::Event event {};
    };

    void note (const Entry& entry) noexcept   // [tick thread]
    {
        const auto n = count.load (std::memory_order_relaxed);
        const auto* from = reinterpret_cast<const std::byte*> (&entry);
        for (std::size_t i = 0; i < words; ++i)
        {
            std::uint64_t word = 0;
            std::memcpy (&word, from + i * sizeof word, sizeof word);
            entries[n % most][i].store (word, std::memory_order_release);
        }
        count.store (n + 1, std::memory_order_release);
    }

    /// How many stops there were so far. [any thread]
    std::uint64_t size() const noexcept { return count.load (std::memory_order_acquire); }

    /// Those after the first `seen` ones that are still there, the oldest first. [any thread]
    std::vector<Entry> since (std::uint64_t seen = 0) const
    {
        const auto end = size();
        std::vector<Entry> all;
        for (auto n = std::max (seen, end < most ? std::uint64_t { 0 } : end - most + 1); n < end; ++n)
        {
            std::array<std::uint64_t, words> copy;
            for (std::size_t i = 0; i < words; ++i)
                copy[i] = entries[n % most][i].load (std::memory_order_acquire);
            if (size() >= n + most) continue;   // its place is taken by a later one, or is being
            std::memcpy (static_cast<void*> (&all.emplace_back()), copy.data(), sizeof (Entry));
        }
        return all;
    }

private:
    static_assert (std::is_trivially_copyable_v<Entry> && sizeof (Entry) % sizeof (std::uint64_t) == 0);
    static constexpr std::size_t words = sizeof (Entry) / sizeof (std::uint64_t);

    std::array<std::array<std::atomic<std::uint64_t>, words>, most> entries {};
    std::atomic<std::uint64_t> count = 0;
};

}   // namespace tactus
