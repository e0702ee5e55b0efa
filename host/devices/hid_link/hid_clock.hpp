// SPDX-License-Identifier: MIT
#pragma once

#include "hid_port.hpp"

#include <tactus/run/tick_clock.hpp>

#include <atomic>
#include <cstdint>

namespace tactus::host::hid
{

/// A device as the clock of a run: each report triggers a tick, and the tick's efforts are sent immediately. The tick thread reads the
/// device itself, if the system lets it (HidPort::readHere); if not, the port's reading thread wakes it. If several reports
/// have arrived, as after a hiccup, only the newest triggers a tick. If none arrives for a few periods, a timer ticks
/// instead, so that the reading ages, the guard removes the force and a stop is noticed; the next report takes over again.
/// Once the device is disconnected, or silent for longer than its watchdog, the clock counts as replaced.
class HidClock final : public TickClock
{
public:
    /// The number of periods without a report before the timer steps in.
    static constexpr double longest_silence = 5.0;

    /// The port must outlive the clock.
    HidClock (HidPort&, double rate_hz);

    void drive (Ticked&) noexcept override;

    bool isReplaced() const noexcept override { return replaced.load (std::memory_order_relaxed); }
    bool isByTimer() const noexcept { return by_timer.load (std::memory_order_relaxed); }            ///< [any thread]
    std::uint64_t ticksByTimer() const noexcept { return timed.load (std::memory_order_relaxed); }   ///< [any thread]

private:
    HidPort& port;
    const HidPort::Clock::duration period, silence, loss;
    std::atomic<bool> by_timer = false, replaced = false;
    std::atomic<std::uint64_t> timed = 0;
};

}   // namespace tactus::host::hid
