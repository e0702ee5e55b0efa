// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid_link/hid_clock.hpp>
#include <host/hid_link/hid_device.hpp>
#include <host/hid_link/open_device.hpp>

#include <filesystem>
#include <optional>
#include <span>
#include <string>

namespace tactus::host
{

/// Opens the devices of a run, those that are really there, too.
class Hardware
{
public:
    explicit Hardware (bool allow) : allowed (allow) {}

    /// As hid::openDevice; offline it refuses real devices (device/real).
    MadeDevice open (const Json& description, const std::filesystem::path& folder);

    /// The rate at which the device that a description means would tick a run; nothing if it has no clock or is not there.
    std::optional<double> clockRate (const Json& description);

private:
    const hid::LoadedProfiles& profiles();

    bool allowed;
    std::optional<hid::LoadedProfiles> loaded;
};

/// A device of a run that is really there.
struct RealDevice
{
    std::string role;
    hid::HidDevice* device = nullptr;
};

/// For the status line: what is worth knowing of the devices now.
std::string statusOf (std::span<const RealDevice>, const hid::HidClock*);

/// At the end: a line or some for each device, of what went in and out.
std::string accountOf (std::span<const RealDevice>, const hid::HidClock*);

}   // namespace tactus::host
