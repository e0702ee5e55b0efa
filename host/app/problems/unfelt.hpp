// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/node/catalogue.hpp>
#include <tactus/text/message.hpp>

namespace tactus::host
{

/// Warnings about what cannot be felt in a graph that has nodes. graph/no_hand: no node reads a device. graph/no_motor: none drives one.
/// graph/hand_unwired, graph/motor_unwired: such a node has no wire. node/no_input: an effect does not know where the tool is, or how hard it
/// presses. layer/empty: nothing is wired into a layer of a mixer. clip/no_file: a clip node has no clip.
/// envelope/no_gate: nothing opens an envelope.
/// mixer/bypassed: a signal reaches a motor past the mixers of the graph. mixer/none: several effects, which are not wired to each other, reach
/// a motor without a mixer. fixOf() adds what is missing, if that is clear.
Messages unfelt (const graph::Graph&, const Catalogue&);

}   // namespace tactus::host
