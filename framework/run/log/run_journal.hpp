// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/kit/threads/spsc_ring.hpp>
#include <tactus/plan/journal.hpp>
#include <tactus/plan/plan.hpp>

#include <atomic>
#include <cstdint>
#include <optional>

namespace tactus
{

/// Records the inputs of a run on the tick thread, for RunLog to write. Once a tick does not fit into the buffer, it and all later
/// ticks are left out, because the run cannot be repeated past a gap.
class RunJournal final : public Journal
{
public:
    /// The first word of an entry: its lowest byte is the kind, the other bytes are a number. Below, a semicolon separates this
    /// number from the words that follow.
    enum class Kind : std::uint8_t
    {
        took,        ///< 0; serial number of the plan
        turned,      ///< number of the instance; number of the knob, target
        outdone,     ///< number of the instance; number of the knob
        struck,      ///< number of the instance; number of the hit input, speed
        late,        ///< 0; number of the query
        passed,      ///< 0; time in s
        halted,      ///< 0
        resumed,     ///< 0
        emergency,   ///< 0
        rearmed,     ///< 0
        tightened,   ///< number of the role; the limits: guard_fields, then dead_man_buttons
        ticked       ///< number of roles; number of feeds, the readings, the feeds. A reading: its numbers, the number of axes and
                     ///< (from bit 8) of signals, and their values
    };

    explicit RunJournal (std::size_t words) : ring (words) {}

    void tookOver (const Plan&) noexcept override;
    void tightened (std::size_t role, const GuardLimits&) noexcept override;
    void turned (std::size_t instance, std::size_t knob, double target) noexcept override;
    void outdone (std::size_t instance, std::size_t knob) noexcept override;
    void struck (std::size_t instance, std::size_t input, double speed) noexcept override;
    void late (std::uint64_t question) noexcept override;
    void passed (double s) noexcept override;
    void halted() noexcept override;
    void resumed() noexcept override;
    void emergency() noexcept override;
    void rearmed() noexcept override;
    void ticked (const Plan&) noexcept override;

    SpscRing<std::uint64_t>& words() noexcept { return ring; }

    /// The first tick that did not fit into the buffer; empty if all have fitted. [any thread]
    std::optional<std::uint64_t> brokenAt() const noexcept;

private:
    static constexpr std::uint64_t whole = ~std::uint64_t { 0 };

    void put (Kind, std::uint64_t number = 0) noexcept;
    void put (double) noexcept;
    void put (const Reading&) noexcept;

    SpscRing<std::uint64_t> ring;
    std::uint64_t now = 0;   // tick number
    bool halting = false;
    std::atomic<std::uint64_t> broken_at = whole;
};

}   // namespace tactus
