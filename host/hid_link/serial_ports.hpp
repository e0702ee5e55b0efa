// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// A serial port of this computer.
struct SerialPort
{
    std::string path;             ///< a name that stays the same when the port is plugged in again, if it has one
    std::string product {};       ///< of a USB device; empty if unknown
    std::string vid {}, pid {};   ///< of a USB device, such as "16c0"; empty if it is none
    bool may_open = true;         ///< by this user
};

/// The serial ports of this computer, sorted by name; empty on systems other than Linux. Nothing is opened. [main thread]
std::vector<SerialPort> serialPorts (const std::filesystem::path& system = "/sys/class/tty", const std::filesystem::path& files = "/dev");

}   // namespace tactus::host::hid
