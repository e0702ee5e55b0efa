// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "audio_rig.hpp"

#include <host/devices/make_device.hpp>

namespace tactus::host::audio
{

/// A device for a role with the driver "audio", in the run whose rig this is. Its guard
/// is as readGuard has it. Ids of readAudioRole, AudioRig::open, audio/no_channels, audio/two_cards. [main thread]
MadeDevice openAudio (const Json& description, AudioRig&);

/// The description with the channels that the nodes of the role ask for, each on the channel of the card with its number,
/// where it names none. [main thread]
Json withChannels (const Json& description, const Plan&, const std::string& role);

}   // namespace tactus::host::audio
