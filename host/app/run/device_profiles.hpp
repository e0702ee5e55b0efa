// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/devices/hid_link/profile_library.hpp>

namespace tactus::host
{

/// The available device profiles, read once. [main thread]
inline const hid::LoadedProfiles& deviceProfiles()
{
    static const auto all = hid::loadProfileLibrary();
    return all;
}

}   // namespace tactus::host
