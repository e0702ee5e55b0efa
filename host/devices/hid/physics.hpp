// SPDX-License-Identifier: MIT
#pragma once

#include "profile.hpp"
#include <host/devices/hid/profile/profile_fields.hpp>

namespace tactus::host::hid
{

/// Reads the member "physics" of a profile: the numbers of the device, each as a value or as an object with its source.
///
///     {"mass": "75 g", "first_mode": {"value": "30 Hz", "source": "…"}, "damping": {"value": "0.1 N*s/m", "guess": true},
///      "workspace": {"min": ["-5 cm", 0, 0], "max": ["5 cm", "6 cm", 0], "source": "…"}}
///
/// A number without its own source comes from the `sources` of the profile. Ids: profile/kind, profile/unit, profile/out_of_range,
/// profile/missing, profile/unknown_key. [main thread]
DeviceNumbers readPhysics (ProfileFields& profile);

/// The numbers of a device, from "physics". Numbers that are missing there come from the limits and the rate of the profile.
/// [main thread]
DeviceNumbers numbersOf (const Profile&);

/// True for a profile that has "physics" but no reports: a device that is known but that Tactus cannot open.
inline bool isNumbersOnly (const Profile& p) { return p.match.empty() && p.inputs.empty() && p.outputs.empty() && ! isEmpty (p.physics); }

}   // namespace tactus::host::hid
