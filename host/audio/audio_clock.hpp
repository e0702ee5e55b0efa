// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/runtime/tick_clock.hpp>

#include <atomic>
#include <chrono>
#include <cstdint>

namespace tactus::host::audio
{

/// A sound card as the clock of a run: each block ticks as often as its length asks for, on the audio thread. So ticks and
/// samples never drift apart. When no blocks come, a timer ticks instead with all forces held at zero; the next block drives
/// again, and forces rise as the guards' ramps have it.
class AudioClock final : public TickClock
{
public:
    /// Without a block for so long the timer steps in; and so long at least where blocks are long.
    static constexpr double longest_silence_s = 0.05;
    static constexpr double longest_silence_blocks = 4.0;

    explicit AudioClock (double tick_rate_hz) : rate_hz (tick_rate_hz) {}

    void drive (Ticked&) noexcept override;
    bool isReplaced() const noexcept override { return by_timer.load (std::memory_order_relaxed); }

    /// The ticks of a block, of which there may be none. [audio thread]
    void block (int frames, double card_rate_hz) noexcept;

    std::uint64_t ticksByTimer() const noexcept { return timed.load (std::memory_order_relaxed); }   // [any thread]

private:
    using Clock = std::chrono::steady_clock;

    bool seize() noexcept { return ! ticking.exchange (true, std::memory_order_acquire); }
    void release() noexcept { ticking.store (false, std::memory_order_release); }

    const double rate_hz;
    std::atomic<bool> ticking = true;   // somebody has the ticks: at first, nobody may
    std::atomic<std::uint64_t> blocks = 0, timed = 0;
    std::atomic<double> block_s = 0.0;
    std::atomic<bool> by_timer = false, over = false;

    // Of whoever has the ticks.
    Ticked* ticked = nullptr;
    double owed = 0.0;   // ticks
};

}   // namespace tactus::host::audio
