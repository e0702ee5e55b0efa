// SPDX-License-Identifier: MIT
#pragma once

#include "hid_port.hpp"

#include <host/devices/hid/profile_reader.hpp>
#include <tactus/run/device/make_device.hpp>

namespace tactus::host::hid
{

/// True if the description selects a real device that has a profile: over HID, or over another wire that the profile names (drivers "hid",
/// "serial" and "udp").
bool isHid (const Json& description);

/// The wire of such a description.
Wire wireOf (const Json& description);

/// True if the port of the description exists. Always true for UDP, where only an answer could tell. For wires other than HID.
bool isThere (const Json& description);

/// Some systems list a device once per HID collection. Keeps one entry per device: the one that a profile fits best.
std::vector<ConnectedDevice> eachOnce (const std::vector<ConnectedDevice>&, const LoadedProfiles&);

/// The HID device that a description selects, found but not opened.
struct FoundDevice
{
    ConnectedDevice device;
    std::shared_ptr<const Profile> profile;   ///< null if there are errors
    Messages messages;                        ///< `where` is relative to the description
};

/// Finds the device of a description such as `{"driver": "hid", "profile": "tactus_board", "serial": "B7", "guard": {…}}`.
/// Without a profile, or with "auto", the most specific profile that fits a connected device is used. The serial number is
/// needed only if several devices fit. The profile "pid" means any device with force feedback according to the USB
/// standard, with a "calibration" (readCalibration); so does "auto" if no profile fits.
///
/// Nothing on a serial line or UDP identifies the device at the other end, so the description names both the profile and the port or address:
/// `{"driver": "serial", "profile": "tactus_board", "port": "/dev/ttyACM0"}`, `{"driver": "udp", "profile": "tactus_board", "port":
/// "192.168.4.1:9750"}`. [main thread]
///
/// Ids: hid/unknown_profile, hid/wire, hid/address, hid/numbers_only, hid/not_connected, hid/several, hid/calibration, those of ObjectReader and profileOf,
/// and the warnings of profiles.
FoundDevice findDevice (const Json& description, HidSystem&, const LoadedProfiles&);

/// The limits from a device's profile, tightened by a description. A device that takes efforts always has a ramp and a watchdog.
GuardLimits limitsOf (const Profile&, const GuardLimits& session);

/// Like makeDevice, but also supports the driver "hid". Ids: those of makeDevice, findDevice and HidPort::open. [main thread]
MadeDevice openDevice (const Json& description, const std::filesystem::path& folder, HidSystem&, const LoadedProfiles&);

/// Checks a description, as far as that is possible without the device. [main thread]
Messages checkDevice (const Json& description, const std::filesystem::path& folder, const LoadedProfiles&);

}   // namespace tactus::host::hid
