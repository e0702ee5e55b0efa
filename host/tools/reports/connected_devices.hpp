// SPDX-License-Identifier: MIT
#pragma once

#include <host/devices/hid/profile_reader.hpp>
#include <host/devices/hid_link/serial_ports.hpp>
#include <host/devices/hid_link/transport.hpp>
#include <tactus/text/json.hpp>

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host
{

/// A HID device of this computer.
struct Listed
{
    hid::ConnectedDevice device;
    std::vector<std::shared_ptr<const hid::Profile>> profiles;   ///< best match first
    bool may_open = true;
    Messages unable;   ///< why a device with force feedback cannot be driven
};

std::vector<Listed> listDevices (const hid::LoadedProfiles&);

std::string hex4 (unsigned);          ///< "046d"
std::string_view nameOf (hid::Bus);   ///< "usb"

/// The degree to which a profile has been verified on a real device.
std::string_view verifiedOf (const hid::Profile&);

Json jsonOf (const Listed&);
Json jsonOf (const hid::SerialPort&, const hid::LoadedProfiles&);

/// HID devices, serial ports, event devices, and the profiles of devices that cannot be opened, as `tactus devices --json` lists them. The command adds
/// sound cards, which libtactus_live cannot open.
Json listedJson (const hid::LoadedProfiles&);

/// The profiles of devices that Tactus knows but cannot open.
std::vector<std::shared_ptr<const hid::Profile>> knownByNumbers (const hid::LoadedProfiles&);

/// Id, name and numbers of a profile, in SI units; each number with its source.
Json numbersJsonOf (const hid::Profile&);

/// These profiles, which have only numbers, for the list of devices; empty if there are none.
std::string numbersText (std::span<const std::shared_ptr<const hid::Profile>>);

}   // namespace tactus::host
