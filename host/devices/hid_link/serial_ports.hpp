// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/profile.hpp>

#include <filesystem>
#include <memory>
#include <span>
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

/// The serial ports of this computer, sorted by name; empty on systems other than Linux and Windows. Nothing is opened. [any thread]
std::vector<SerialPort> serialPorts (const std::filesystem::path& system = "/sys/class/tty", const std::filesystem::path& files = "/dev");

/// True if the profile fits the USB device of this port, by vendor and product. [any thread]
bool isOf (const SerialPort&, const Profile&);

/// The profiles with which a device at this port could be driven: all that name a serial line, because nothing on the line says which device it is.
/// Those of this very USB device come first, else in the order in which they are given. [any thread]
std::vector<std::shared_ptr<const Profile>> profilesFor (const SerialPort&, std::span<const std::shared_ptr<const Profile>>);

}   // namespace tactus::host::hid
