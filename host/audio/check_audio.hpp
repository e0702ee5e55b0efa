// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "audio_settings.hpp"

#include <framework/guard.hpp>

namespace tactus::host::audio
{

/// The guard of a role that has these channels: with a ramp of 0.2 s where nobody says how long. Ids as of readGuardLimits.
GuardLimits readGuard (const Json& description, const AudioRole&, Messages&);

/// What is wrong with a description with the driver "audio", as far as one can see without a card. One that names no channels
/// gets those that its graph asks for. [main thread]
Messages checkAudio (const Json& description);

}   // namespace tactus::host::audio
