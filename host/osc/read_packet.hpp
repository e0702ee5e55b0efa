// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_osc/juce_osc.h>

#include <string_view>
#include <vector>

namespace tactus::host
{

/// The messages of an OSC packet (OSC 1.0), those of bundles among them, in order: as many as are right before the first
/// that is not. Of arguments it knows int, float and string, and passes over blobs.
///
/// Not left to juce::OSCReceiver, since anybody may send anything: that one calls itself for each bundle in a bundle, so
/// that 3000 of them in one datagram take more than 1 MB of stack and some tenths of a second, and adds to the sizes of
/// blobs without a look at them.
struct Packet
{
    std::vector<juce::OSCMessage> messages;
    bool right = false;   ///< to its end
};

Packet readPacket (std::string_view bytes);

}   // namespace tactus::host
