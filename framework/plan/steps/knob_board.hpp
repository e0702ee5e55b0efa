// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <deque>

namespace tactus::plan
{

/// Tells the tick thread which nodes have been turned or hit, so that it need not look at every node. Each compilation has a board, with a
/// place for each node whose knobs it makes. Any thread may mark a place. One word holds 64 places.
class KnobBoard
{
public:
    /// A new place. Only before a plan with this board runs. [main thread]
    std::uint32_t add()
    {
        if (places % 64 == 0) words.emplace_back (0);
        return places++;
    }

    /// Everything written before is visible to the tick thread when it sees the mark. [any thread]
    void mark (std::uint32_t place) noexcept { words[place / 64].fetch_or (std::uint64_t { 1 } << place % 64, std::memory_order_release); }

    /// Calls `visit (place)` for each marked place that is wanted, and removes the mark. Other marks stay: a plan that is waiting
    /// may want them. [tick thread]
    template <typename IsWanted, typename Visit>
    void take (const IsWanted& isWanted, const Visit& visit) noexcept
    {
        for (std::uint32_t first = 0; auto& word : words)
        {
            std::uint64_t wanted = 0;
            for (auto marks = word.load (std::memory_order_relaxed); marks != 0; marks &= marks - 1)
                if (isWanted (first + static_cast<std::uint32_t> (std::countr_zero (marks)))) wanted |= marks & -marks;
            if (wanted != 0)
                for (auto taken = word.fetch_and (~wanted, std::memory_order_acquire) & wanted; taken != 0; taken &= taken - 1)
                    visit (first + static_cast<std::uint32_t> (std::countr_zero (taken)));
            first += 64;
        }
    }

    std::uint32_t size() const noexcept { return places; }

    bool started = false;   ///< a plan with this board has ticked: new targets start a ramp   [tick thread]

private:
    std::deque<std::atomic<std::uint64_t>> words;
    std::uint32_t places = 0;
};

}   // namespace tactus::plan
