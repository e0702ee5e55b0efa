// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"

namespace tactus::host::hid
{

/// The stricter of the two values of each limit. What describes a device instead of limiting it is that of `a`.
Limits tightest (const Limits& a, const Limits& b);

/// The keys that keep the limits of `other` from meaning the same under the user's profile, as in "\"inputs\", \"rate\""; empty if there
/// are none. Two profiles may differ in their names, in texts for people, samples and `match`, and in limits that `tightest` tightens.
/// Everything else, including every key that is added to profiles later, must be equal, unless the user's profile sends nothing.
std::string differenceOf (const Profile& own, const Profile& other);

}   // namespace tactus::host::hid
