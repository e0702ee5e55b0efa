// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid_link/hid_port.hpp>
#include <host/runtime/tick_clock.hpp>

#include <atomic>
#include <cstdint>

namespace tactus::host::hid
{

/// A device as the clock of a run: a report comes, there is a tick, and what it gives is sent at once. Where several reports
/// have come, as after a hiccup, there is one tick for the newest. If none comes for some periods, a timer ticks instead, so
/// that the reading grows old, the guard takes the force off and a stop is heard; the next report drives again. Once the device
/// is away, or silent for longer than its watchdog, its clock counts as replaced.
class HidClock final : public TickClock
{
public:
    /// Periods without a report before the timer steps in.
    static constexpr double longest_silence = 5.0;

    /// The port outlives the clock.
    HidClock (HidPort&, double rate_hz);

    void drive (Ticked&) noexcept override;

    bool isReplaced() const noexcept override { return replaced.load (std::memory_order_relaxed); }
    bool isByTimer() const noexcept { return by_timer.load (std::memory_order_relaxed); }            ///< now [any thread]
    std::uint64_t ticksByTimer() const noexcept { return timed.load (std::memory_order_relaxed); }   ///< [any thread]

private:
    HidPort& port;
    const HidPort::Clock::duration period, silence, loss;
    std::atomic<bool> by_timer = false, replaced = false;
    std::atomic<std::uint64_t> timed = 0;
};

}   // namespace tactus::host::hid
