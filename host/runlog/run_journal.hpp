// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/journal.hpp>
#include <framework/plan/plan.hpp>
#include <host/runtime/word_ring.hpp>

#include <atomic>
#include <cstdint>
#include <optional>

namespace tactus::host
{

/// Takes down on the tick thread what a run is told, for RunLog to write. Once a tick finds no room, this one and all later
/// ones are left out, since what comes after a gap repeats nothing.
class RunJournal final : public Journal
{
public:
    /// How a word begins; its lower byte says what, the others a number.
    enum class Kind : std::uint8_t
    {
        took,        ///< 0, serial of the plan
        turned,      ///< number of the instance; number of the knob, target
        outdone,     ///< number of the instance; number of the knob
        struck,      ///< number of the instance; number of the input for hits, speed
        late,        ///< 0; number of the question
        halted,      ///< 0
        resumed,     ///< 0
        emergency,   ///< 0
        rearmed,     ///< 0
        ticked       ///< number of roles; number of feeds, the readings, the feeds. A reading is its numbers, how many axes and (from bit 8) signals, and those
    };

    explicit RunJournal (std::size_t words) : ring (words) {}

    void tookOver (const Plan&) noexcept override;
    void turned (std::size_t instance, std::size_t knob, double target) noexcept override;
    void outdone (std::size_t instance, std::size_t knob) noexcept override;
    void struck (std::size_t instance, std::size_t input, double speed) noexcept override;
    void late (std::uint64_t question) noexcept override;
    void halted() noexcept override;
    void resumed() noexcept override;
    void emergency() noexcept override;
    void rearmed() noexcept override;
    void ticked (const Plan&) noexcept override;

    WordRing& words() noexcept { return ring; }

    /// The first tick that found no room. [any thread]
    std::optional<std::uint64_t> brokenAt() const noexcept;

private:
    static constexpr std::uint64_t whole = ~std::uint64_t { 0 };

    void put (Kind, std::uint64_t number = 0) noexcept;
    void put (double) noexcept;
    void put (const Reading&) noexcept;

    WordRing ring;
    std::uint64_t now = 0;   // tick
    bool halting = false;
    std::atomic<std::uint64_t> broken_at = whole;
};

}   // namespace tactus::host
