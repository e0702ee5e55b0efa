// SPDX-License-Identifier: MIT
#pragma once

#include "audio_settings.hpp"

#include <tactus/run/guard.hpp>

namespace tactus::host::audio
{

/// The guard limits of a role with these channels, with a default ramp of 0.2 s. Ids: those of readGuardLimits.
GuardLimits readGuard (const Json& description, const AudioRole&, Messages&);

/// Checks a description with the driver "audio", as far as that is possible without a card. A description without channels
/// gets the channels that its graph uses. [main thread]
Messages checkAudio (const Json& description);

}   // namespace tactus::host::audio
