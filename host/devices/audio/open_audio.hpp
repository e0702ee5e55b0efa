// SPDX-License-Identifier: MIT
#pragma once

#include "audio_rig.hpp"

#include <tactus/run/device/make_device.hpp>

namespace tactus::host::audio
{

/// Opens the device of a role with the driver "audio" in the run of this rig. Its guard limits come from readGuard. Ids:
/// those of readAudioRole and AudioRig::open, audio/no_channels, audio/two_cards. [main thread]
MadeDevice openAudio (const Json& description, AudioRig&);

/// If the description names no channels, adds the channels that the nodes of the role use, each on the card channel with the
/// same number. [main thread]
Json withChannels (const Json& description, const Plan&, const std::string& role);

}   // namespace tactus::host::audio
