// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/node/device.hpp>
#include <tactus/run/guard.hpp>

namespace tactus::host
{

/// The last limit before a driver, by the wall clock: whatever ticks the run, and however long a write takes, the device gets no effort beyond its hard
/// limits, and none changes faster than they and the slew limits of the role's guard allow. A value that is not a number becomes 0.
///
/// Force and torque are limited as vectors, so they keep their directions; each axis and each signal by itself.
class EffortLimiter
{
public:
    explicit EffortLimiter (const GuardLimits& hard) noexcept : limits (hard) {}

    /// Adds slew limits, per s.
    void tighten (double force, double torque, double axis) noexcept;

    /// The effort that may be sent now, `passed_s` after the last call.
    const Effort& operator() (const Effort& wanted, double passed_s) noexcept;

    /// True if a slew limit keeps the last effort from what was wanted.
    bool isBehind() const noexcept { return behind; }

    /// The device is at rest.
    void forget() noexcept;

private:
    GuardLimits limits;
    Effort last {};
    bool behind = false;
};

}   // namespace tactus::host
