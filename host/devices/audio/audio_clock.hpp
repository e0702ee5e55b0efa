// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/run/tick_clock.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>

namespace tactus::host::audio
{

/// A sound card as the clock of a run: each block triggers as many ticks as fit into its length, on the audio thread, so ticks
/// and samples never drift apart. When no blocks arrive, a timer ticks instead with all forces held at zero. The next block
/// takes over again, and forces rise along the guards' ramps.
class AudioClock : public TickClock
{
public:
    /// The timer steps in after this time without a block, or if blocks are long, after this many block lengths.
    static constexpr double longest_silence_s = 0.05;
    static constexpr double longest_silence_blocks = 4.0;

    explicit AudioClock (double tick_rate_hz) : rate_hz (tick_rate_hz) {}

    void drive (Ticked&) noexcept override;
    bool isReplaced() const noexcept override { return by_timer.load (std::memory_order_relaxed); }
    double block_s() const noexcept override { return last_block_s.load (std::memory_order_relaxed); }

    /// Runs the ticks of a block, possibly none. [audio thread]
    void block (int frames, double card_rate_hz) noexcept;

    std::uint64_t ticksByTimer() const noexcept { return timed.load (std::memory_order_relaxed); }   // [any thread]

private:
    using Clock = std::chrono::steady_clock;

    bool seize() noexcept { return ! ticking.exchange (true, std::memory_order_acquire); }
    void release() noexcept { ticking.store (false, std::memory_order_release); }

    const double rate_hz;
    std::atomic<bool> ticking = true;   // true while a thread ticks; initially true, so that no thread may tick yet
    std::atomic<std::uint64_t> blocks = 0, timed = 0;
    std::atomic<double> last_block_s = 0.0;
    std::atomic<bool> by_timer = false, over = false;

    // [the thread that ticks]
    Ticked* ticked = nullptr;
    double owed = 0.0;   // ticks that are due but have not run yet
};

}   // namespace tactus::host::audio
