// SPDX-License-Identifier: MIT
#pragma once

#include "profile_fields.hpp"
#include <host/devices/hid/profile.hpp>

namespace tactus::host::hid
{

/// Checks that need the whole profile: unknown names, wrong units, too many items. Messages refer to the fields of the
/// profile. [main thread]
void checkProfile (const Profile&, ProfileFields&);

}   // namespace tactus::host::hid
