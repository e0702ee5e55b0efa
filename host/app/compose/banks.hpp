// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Banks: mixers before the motors, one for each input of a device. Signals become layers of them on their way to a motor.

#include "sinks.hpp"

#include <tactus/graph/edit.hpp>
#include <tactus/node/catalogue.hpp>

namespace tactus::host::compose
{

/// Ensures that a mixer is before an input of a device node at the top of the graph, with each wire into this input as a layer, in the same order.
/// Returns the name of the mixer. Ids: mixer/full.
Result<std::string> bankBefore (graph::Patch& root, const std::string& sink, const SinkPort&, const Catalogue&);

/// Wires a signal into a new layer of a mixer, or into its only layer if that is empty. Ids: mixer/full.
Result<> addStrip (graph::Patch& root, const std::string& mixer, const graph::Endpoint& from, const std::string& label, const Catalogue&);

/// Makes layers of all signals that reach a motor. Ids: those of liftSinks.
Result<> mixAll (graph::Graph&, const Catalogue&);

/// An input of a motor that some signals reach without passing a mixer.
struct Bypassed
{
    std::string sink, port;             ///< the path of the node, and its input
    std::string mixer;                  ///< path; "" if none stands before this input
    std::vector<std::string> sources;   ///< the ports that bypass it: "wall.force"
    bool has_bank = false;              ///< a mixer is wired directly into this input, or into another one
};

/// The inputs of motors that some signals reach past a mixer: one before this input, or before another. Without any mixer, the inputs that several effects
/// reach. Signals whose nodes are wired to each other are one effect, such as a wall, and the friction that its force presses on; the hand, and wires to
/// parameters, join nothing. Of several instances of a subgraph, the first one counts.
std::vector<Bypassed> bypassedBanks (const graph::Graph&, const Catalogue&);

/// Makes layers of the signals that reach this input. A motor inside a subgraph moves to the top of the graph with all others. Ids: those of mixAll.
Result<graph::Command> mixIn (const graph::Graph&, const std::string& sink, std::string_view port, const Catalogue&);

}   // namespace tactus::host::compose
