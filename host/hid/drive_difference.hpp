// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "profile.hpp"

namespace tactus::host::hid
{

/// How a profile drives a device differently from another profile for it, such as "'fx' has a different scale"; empty if there is
/// no difference. Without a difference, the same newtons give the same bytes, and the same motion gives the same readings, so the
/// limits of the other profile mean the same. A profile may drive fewer fields, have narrower bounds, and have more alarms. A
/// profile without output reports drives nothing.
std::string driveDifference (const Profile& own, const Profile& other);

}   // namespace tactus::host::hid
