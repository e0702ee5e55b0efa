// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/guard.hpp>

#include <tactus/kit/threads/snapshot.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace tactus
{

/// The latest stops of all guards of an engine. One thread adds entries while any thread reads them. There are no locks and no
/// waiting, and adding allocates nothing.
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
        entries[n % most].store (entry);
        count.store (n + 1, std::memory_order_release);
    }

    /// The number of stops so far. [any thread]
    std::uint64_t size() const noexcept { return count.load (std::memory_order_acquire); }

    /// The stops after the first `seen` that are still in the log, oldest first. [any thread]
    std::vector<Entry> since (std::uint64_t seen = 0) const
    {
        const auto end = size();
        std::vector<Entry> all;
        for (auto n = std::max (seen, end < most ? std::uint64_t { 0 } : end - most + 1); n < end; ++n)
            // An entry whose slot a later stop has taken, or is about to take, is skipped.
            if (const auto entry = entries[n % most].load(); size() < n + most) all.push_back (entry);
        return all;
    }

private:
    std::array<Snapshot<Entry>, most> entries;
    std::atomic<std::uint64_t> count = 0;
};

}   // namespace tactus
