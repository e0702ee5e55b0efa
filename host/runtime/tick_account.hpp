// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tactus::host
{

/// How long something took, many times over. One thread notes, any may look meanwhile: no locks, no waiting.
class Durations
{
public:
    void note (double s) noexcept;   // [tick thread]

    /// The duration that this part of all (0…1) did not exceed, within 9 %; 0 if there is none. [any thread]
    double quantile (double part) const noexcept;
    double longest() const noexcept { return longest_s.load (std::memory_order_relaxed); }

private:
    static constexpr int per_octave = 8;
    static constexpr double shortest = 100e-9;   // s, all below is one
    static constexpr std::size_t bins = 30 * per_octave;

    std::array<std::atomic<std::uint64_t>, bins> counts {};
    std::atomic<double> longest_s = 0.0;
};

/// How the ticks of a run come: how late each began, how long it took, what was missed.
class TickAccount
{
public:
    /// A graph that takes longer than its period for so long does not get on any more. A busy machine makes ticks long
    /// too, but not all of them.
    static constexpr double longest_overrun_s = 0.5;

    explicit TickAccount (double period_s) : period (period_s) {}

    void note (double late_s, double took_s) noexcept;   // [tick thread]

    const Durations& lateness() const noexcept { return late; }                                 ///< [any thread]
    const Durations& computing() const noexcept { return took; }                                ///< [any thread]
    std::uint64_t ticks() const noexcept { return count.load (std::memory_order_relaxed); }     ///< [any thread]
    std::uint64_t misses() const noexcept { return missed.load (std::memory_order_relaxed); }   ///< began a period late, or more [any thread]
    bool isOverrun() const noexcept { return overrun_s > longest_overrun_s; }                   ///< every tick for so long was too long [tick thread]

private:
    double period;
    Durations late, took;
    std::atomic<std::uint64_t> count = 0, missed = 0;
    double overrun_s = 0.0;
};

}   // namespace tactus::host
