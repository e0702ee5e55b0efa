// SPDX-License-Identifier: MIT
#pragma once

#include "serial_ports.hpp"

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host::hid
{

/// A device at a serial port that has a driver and no profile.
struct DriverPort
{
    const char* vid;
    const char* pid;
    const char* driver;   ///< as in --device ROLE=DRIVER:PORT
    const char* what;     ///< for people: "a Novint Falcon"
};

/// The device at this port; null: no driver names it. [any thread]
const DriverPort* driverOf (const SerialPort&);

/// The device of this driver, for one that has no list of its own; null: it has no such device. [any thread]
const DriverPort* deviceOf (std::string_view driver);

/// The ports of this driver's devices, as in --device ROLE=DRIVER:PORT: serial ports or, if the kernel has made none for them, "usb", "usb:1" … [any thread]
std::vector<std::string> portsOf (const DriverPort&, std::span<const SerialPort>, const std::filesystem::path& usb = "/sys/bus/usb/devices");

/// The list of devices that a driver knows, but that have no serial port because the kernel does not know them, with the command that gives them one.
/// Empty if there are none. [any thread]
std::string withoutPort (std::span<const SerialPort>, const std::filesystem::path& usb = "/sys/bus/usb/devices");

}   // namespace tactus::host::hid
