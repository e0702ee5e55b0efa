// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

namespace tactus
{

/// Statistics of a duration measured many times. One thread adds values while any thread reads. There are no locks and no
/// waiting.
class Durations
{
public:
    void note (double s) noexcept;   // [tick thread]

    /// The quantile for this fraction (0…1), accurate to within 9 %; 0 if nothing was measured. [any thread]
    double quantile (double part) const noexcept;
    double longest() const noexcept { return longest_s.load (std::memory_order_relaxed); }

private:
    static constexpr int per_octave = 8;
    static constexpr double shortest = 100e-9;   // in s; shorter durations share one bin
    static constexpr std::size_t bins = std::size_t { 30 } * per_octave;

    std::array<std::atomic<std::uint64_t>, bins> counts {};
    std::atomic<double> longest_s = 0.0;
};

/// Timing of the ticks of a run: how late each one began, how long it took, and how many were missed.
class TickAccount
{
public:
    /// If every tick takes longer than its period for this long, the graph is too slow, which is called an overrun. A busy
    /// machine also makes some ticks long, but not all of them.
    static constexpr double longest_overrun_s = 0.5;

    explicit TickAccount (double period_s) : period (period_s) {}

    void note (double late_s, double took_s) noexcept;   // [tick thread]

    const Durations& lateness() const noexcept { return late; }                                 ///< [any thread]
    const Durations& computing() const noexcept { return took; }                                ///< [any thread]
    std::uint64_t ticks() const noexcept { return count.load (std::memory_order_relaxed); }     ///< [any thread]
    std::uint64_t misses() const noexcept { return missed.load (std::memory_order_relaxed); }   ///< ticks that began at least one period late [any thread]
    /// True if every tick has taken longer than its period, for more than longest_overrun_s. [tick thread]
    bool isOverrun() const noexcept { return overrun_s > longest_overrun_s; }

private:
    double period;
    Durations late, took;
    std::atomic<std::uint64_t> count = 0, missed = 0;
    double overrun_s = 0.0;
};

}   // namespace tactus
