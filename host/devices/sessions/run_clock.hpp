// SPDX-License-Identifier: MIT
#pragma once

#include "awaited_device.hpp"

#include <host/devices/hid_link/hid_clock.hpp>

#include <optional>

namespace tactus::host
{

/// The clock of a run that is ticked by a device that is connected or still awaited. Until the device is available, a timer
/// ticks the run at the rate of the device; then the reports of the device tick it (HidClock).
class RunClock final : public TickClock
{
public:
    /// The device must outlive the clock. [main thread]
    RunClock (hid::HidDevice&, double rate_hz);
    RunClock (const AwaitedDevice&, double rate_hz);

    void drive (Ticked&) noexcept override;

    bool isReplaced() const noexcept override;     ///< true if the device is missing, disconnected or silent
    bool isByTimer() const noexcept;               ///< true while a timer ticks the run   [any thread]
    std::uint64_t ticksByTimer() const noexcept;   ///< [any thread]

private:
    class TimerUntilDevice;

    const double rate;
    const AwaitedDevice* awaited = nullptr;
    std::optional<hid::HidClock> by_reports;   // constructed once the device is available
    std::atomic<bool> is_there = false;
    std::atomic<std::uint64_t> waited = 0;   // ticks before the device was available
};

}   // namespace tactus::host
