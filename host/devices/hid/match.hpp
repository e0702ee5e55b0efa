// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tactus::host::hid
{

/// The data about a device that are known before it is opened.
struct DeviceInfo
{
    std::uint16_t vid = 0, pid = 0;
    std::uint16_t usage_page = 0, usage = 0;   ///< 0 if the platform does not provide them
    int interface_number = -1;                 ///< -1 if unknown
    Bus bus = Bus::unknown;
    std::string product;
};

/// The score of how well a profile fits. 0: not at all; a more specific rule scores higher.
int fit (const Profile&, const DeviceInfo&) noexcept;

/// The profiles that fit, most specific first; profiles with the same score are sorted by id.
std::vector<std::shared_ptr<const Profile>> matching (std::span<const std::shared_ptr<const Profile>>, const DeviceInfo&);

}   // namespace tactus::host::hid
