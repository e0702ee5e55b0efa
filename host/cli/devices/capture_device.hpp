// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/hid_link/open_device.hpp>

#include <memory>
#include <string>

namespace tactus::host
{

/// A connected device and the profile that describes it; null: none fits.
struct ChosenDevice
{
    hid::ConnectedDevice device;
    std::shared_ptr<const hid::Profile> profile;
};

/// The device that --device names: "hid:PROFILE", "serial:PROFILE@PORT", "udp:PROFILE@ADDRESS", or the path of a device. Without a name, the only HID
/// device with a profile. Ends the command if there is none. [main thread]
ChosenDevice chooseDevice (const std::string& text, const hid::LoadedProfiles&);

/// The options of `tactus devices --capture`: what it records, and where.
struct DeviceCapture
{
    std::string file;
    std::string device;        ///< as in --device, or the path of a device; empty: the only one with a profile
    int baud = 115200;         ///< of a serial port without a profile
    double duration_s = 0.0;   ///< 0: until Ctrl-C
};

/// Records all reports that a device sends and gets. It is initialised as its profile specifies, but not driven; without a profile nothing is sent.
/// Ends the command if that is not possible. [main thread]
void captureDevice (const DeviceCapture&);

/// From now on, devices open where the system has no guardian. Call it only where nothing is driven, and after the drivers in plugins: they may enable motors
/// as they open. Does nothing on Linux. [main thread]
void readUnguarded() noexcept;

}   // namespace tactus::host
