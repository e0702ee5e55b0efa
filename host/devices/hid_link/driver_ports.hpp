// SPDX-License-Identifier: MIT
#pragma once

#include "serial_ports.hpp"

#include <filesystem>
#include <span>
#include <string>

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

/// The list of devices that a driver knows, but that have no serial port because the kernel does not know them, with the command that gives them one.
/// Empty if there are none. [any thread]
std::string withoutPort (std::span<const SerialPort>, const std::filesystem::path& usb = "/sys/bus/usb/devices");

}   // namespace tactus::host::hid
