// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Sends: layers of a mixer that another device of the graph also plays. The sends to an output go through a bus, which is a mixer before
/// that output with a layer for each send. So a send is made of ordinary nodes and wires, and its gain is the gain of a layer.

#include "mixer.hpp"

namespace tactus::host
{

/// An output that layers of a mixer can be sent to.
struct SendTarget
{
    std::string sink;   ///< the node, such as a device.signal_out
    std::string name;   ///< its role, or the node if it has no role
};

/// The outputs in the patch of a mixer that the mixer does not drive.
std::vector<SendTarget> sendTargets (const graph::Graph&, const MixerPlace&);

struct Send
{
    SendTarget to;
    MixerPlace bus;
    int layer = 0;   ///< of the bus
};

/// The sends of one layer.
std::vector<Send> sendsOf (const graph::Graph&, const MixerPlace&, const Catalogue&, int layer);

/// Sends a layer to an output, before its gain, mute and solo. A number pushes the tool of a device along z. Of a vector, a vibration
/// motor plays the sum of its components; its length would sound an octave too high. Ids: mixer/gone, mixer/empty, mixer/full.
Result<graph::Command> addSend (const graph::Graph&, const MixerPlace&, const Catalogue&, int layer, const std::string& sink);

/// Adds a vibration motor as a new role, and sends the layer to it. Ids: those of addSend().
Result<graph::Command> addSendToNewMotor (const graph::Graph&, const MixerPlace&, const Catalogue&, int layer);

/// Removes a send. Removing the last send of a bus also removes the bus. Ids: those of removeLayer().
Result<graph::Command> removeSend (const graph::Graph&, const Send&, const Catalogue&);

}   // namespace tactus::host
