// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/profile_reader.hpp>
#include <host/devices/hid_link/serial_ports.hpp>
#include <tactus/text/json.hpp>
#include <tactus/text/result.hpp>

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// A device that a user may choose for a role, and that is not found by its HID ids.
struct OfferedDevice
{
    std::string name;       ///< of the device, for people
    Json description;       ///< without a guard
    bool is_sure = true;    ///< false: it may be another device
    bool may_open = true;   ///< by this user

    bool operator== (const OfferedDevice&) const = default;
};

/// The devices that these serial ports may lead to, as `tactus devices` lists them: the one that a driver or a profile names by the ids of its USB
/// device; else, one for each profile with a serial line. [any thread]
std::vector<OfferedDevice> devicesAt (std::span<const hid::SerialPort>, const hid::LoadedProfiles&);

/// The devices at the serial ports of this computer, by devicesAt(). Opens none of them. [any thread]
std::vector<OfferedDevice> offeredDevices (const hid::LoadedProfiles&);

/// The devices that the drivers in plugins find, as findDevices(): it loads all of them. `messages`: of drivers that cannot look. [any thread, one at a time]
std::vector<OfferedDevice> foundDevices (Messages&);

/// Reads the address of a device as a user types it: hid:PROFILE, serial:PROFILE@PORT, udp:PROFILE@ADDRESS:PORT, or DRIVER:PORT for a driver in a
/// plugin. Loads no driver. Id: device/address. [main thread]
Result<Json> readAddress (std::string_view, const hid::LoadedProfiles&);

}   // namespace tactus::host
