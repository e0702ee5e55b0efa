// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <host/hid/profile.hpp>
#include <host/hid/profile_fields.hpp>

namespace tactus::host::hid
{

/// What only the whole of a profile shows: names that nothing has, units that do not fit, too much of something.
/// Messages go to the fields of the profile. [main thread]
void checkProfile (const Profile&, ProfileFields&);

}   // namespace tactus::host::hid
