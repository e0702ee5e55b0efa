// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/make_device.hpp>
#include <host/hid/profile_reader.hpp>
#include <host/hid_link/hid_port.hpp>

namespace tactus::host::hid
{

/// True of a description that means a real device.
bool isHid (const Json& description);

/// Systems list a device once for each of its collections; this leaves the entry of each that a profile fits best.
std::vector<ConnectedDevice> eachOnce (const std::vector<ConnectedDevice>&, const LoadedProfiles&);

/// A HID device that a description asks for, found but not opened.
struct FoundDevice
{
    ConnectedDevice device;
    std::shared_ptr<const Profile> profile;   ///< null if there are errors
    Messages messages;                        ///< `where` relative to the description
};

/// `{"driver": "hid", "profile": "tactus_board", "serial": "B7", "guard": {…}}`: without a profile, or with "auto", the one
/// that says most about what is connected; the serial number is only needed where several would do. The profile "pid", and
/// where no profile fits also "auto", is any device with force feedback by the USB standard, with a "calibration"
/// (readCalibration). [main thread]
///
/// Ids: hid/unknown_profile, hid/not_connected, hid/several, hid/calibration, those of Fields and profileOf, and warnings of
/// profiles.
FoundDevice findDevice (const Json& description, HidSystem&, const LoadedProfiles&);

/// What a device's profile allows and a description tightens. A device that takes efforts always has a ramp and a watchdog.
GuardLimits limitsOf (const Profile&, const GuardLimits& session);

/// makeDevice, and the driver "hid" beside its others. Ids as well of findDevice and HidPort::open. [main thread]
MadeDevice openDevice (const Json& description, const std::filesystem::path& folder, HidSystem&, const LoadedProfiles&);

/// What is wrong with a description, as far as one can see without the device. [main thread]
Messages checkDevice (const Json& description, const std::filesystem::path& folder, const LoadedProfiles&);

}   // namespace tactus::host::hid
