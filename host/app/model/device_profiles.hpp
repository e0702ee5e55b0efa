// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid_link/profile_shelf.hpp>

namespace tactus::host
{

/// The device profiles at hand, read once. [main thread]
inline const hid::LoadedProfiles& deviceProfiles()
{
    static const auto all = hid::profilesAtHand();
    return all;
}

}   // namespace tactus::host
