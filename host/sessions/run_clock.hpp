// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "awaited_device.hpp"

#include <host/hid_link/hid_clock.hpp>

#include <optional>

namespace tactus::host
{

/// The clock of a run that a device ticks, there already or awaited. Until it is there a timer ticks in its place, at its
/// rate; then its reports do, as HidClock has it.
class RunClock final : public TickClock
{
public:
    /// The device outlives the clock. [main thread]
    RunClock (hid::HidDevice&, double rate_hz);
    RunClock (const AwaitedDevice&, double rate_hz);

    void drive (Ticked&) noexcept override;

    bool isReplaced() const noexcept override;     ///< it is not there, away or silent
    bool isByTimer() const noexcept;               ///< now [any thread]
    std::uint64_t ticksByTimer() const noexcept;   ///< [any thread]

private:
    class Waiting;

    const double rate;
    const AwaitedDevice* awaited = nullptr;
    std::optional<hid::HidClock> by_reports;   // made once the device is there
    std::atomic<bool> is_there = false;
    std::atomic<std::uint64_t> waited = 0;   // ticks
};

}   // namespace tactus::host
