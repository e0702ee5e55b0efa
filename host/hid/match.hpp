// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// What is known of a device before it is opened.
struct DeviceInfo
{
    std::uint16_t vid = 0, pid = 0;
    std::uint16_t usage_page = 0, usage = 0;   ///< 0 where the platform does not tell
    int interface_number = -1;                 ///< -1 where it is not known
    Bus bus = Bus::unknown;
    std::string product;
};

/// How well a profile fits: 0 not at all, else the more the more it says about the device.
int fit (const Profile&, const DeviceInfo&) noexcept;

/// The profiles that fit, the one that says most first; among equals, by id.
std::vector<std::shared_ptr<const Profile>> matching (std::span<const std::shared_ptr<const Profile>>, const DeviceInfo&);

}   // namespace tactus::host::hid
