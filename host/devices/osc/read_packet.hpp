// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <juce_osc/juce_osc.h>

#include <string_view>
#include <vector>

namespace tactus::host
{

/// The messages of an OSC packet (OSC 1.0), including those in bundles, in order, without malformed ones. Supports int, float, string, double and long
/// arguments, true, false, impulse (1, 0, 1) and nil (no argument), and skips blobs. A message that asks for a stop counts even if its arguments cannot be
/// read: it then has none.
///
/// We do not use juce::OSCReceiver, because anyone may send anything: it recurses for each nested bundle, so 3000 of
/// them in one datagram take more than 1 MB of stack and a few tenths of a second, and it adds up blob sizes without
/// checking them.
struct Packet
{
    std::vector<juce::OSCMessage> messages;
    bool right = false;   ///< true if the packet is well-formed to its end
};

Packet readPacket (std::string_view bytes);

}   // namespace tactus::host
