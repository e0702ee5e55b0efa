// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/failsafe/failsafe.hpp>
#include <tactus/node/device.hpp>
#include <tactus/run/guard.hpp>
#include <tactus/tactus_device.h>
#include <tactus/text/message.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host
{

/// The description of a driver's device, copied and checked.
struct DriverAbout
{
    std::string about;   ///< a sentence
    bool position = false, rotation = false, pressure = false, force = false, torque = false;
    DeviceLayout layout {};
    double rate_hz = 0.0;    ///< of the readings; 0: not regular
    GuardLimits limits {};   ///< the hard limits; a device that takes efforts always has a ramp and a watchdog
    std::string rest_file {};
    std::vector<Failsafe::Report> rest_reports {};   ///< for the failsafe; none: only the watchdog of the device brings it to rest
    double device_watchdog_s = 0.0;
    std::uint32_t unrendered = 0;   ///< TACTUS_DEVICE_NO_FORCE_X | …, all of a force or a torque that the device does not have
    std::uint32_t stamps = 0;       ///< TACTUS_DEVICE_NUMBERS | …: what every reading must have

    /// The part of a force or a torque that the motors render.
    Vec3 renderedForce (const Vec3& all) const noexcept { return rendered (all, TACTUS_DEVICE_NO_FORCE_X); }
    Vec3 renderedTorque (const Vec3& all) const noexcept { return rendered (all, TACTUS_DEVICE_NO_TORQUE_X); }

    bool takesEfforts() const noexcept { return force || torque || ! layout.efforts.empty() || layout.signal_outputs > 0; }

    /// True if a device that was opened again is the same: graphs and guards know its parts and limits.
    bool isLike (const DriverAbout&) const;

private:
    Vec3 rendered (Vec3 all, std::uint32_t first) const noexcept
    {
        for (int axis = 0; axis < 3; ++axis)
            if ((unrendered & first << axis) != 0) all[axis] = 0.0;
        return all;
    }
};

/// Copies and checks what a driver says. After errors, the device must not be used. `can_write`: the driver has the functions for efforts.
/// Ids: device/bad_driver, device/no_limits, device/no_failsafe, device/slow_stop, and those of readGuardLimits. [any thread]
DriverAbout readAbout (const tactus_device_about&, bool can_write, Messages&);

/// Arms the failsafe of a device that takes efforts. Without reports that bring the device to rest, the failsafe only notices that the program was
/// frozen or that the computer has slept. Null for a device that takes no efforts, and on systems without a failsafe. Id: device/failsafe; then
/// the device must not be used. [main thread, or one that opens devices]
Result<std::optional<Failsafe>> armFailsafe (const DriverAbout&);

}   // namespace tactus::host
