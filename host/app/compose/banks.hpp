// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Banks: the mixers before the motors, one for each input of a device. Everything that reaches a motor is a layer of one of them.

#include "sinks.hpp"

#include <tactus/graph/edit.hpp>
#include <tactus/node/catalogue.hpp>

namespace tactus::host::compose
{

/// The mixer before an input of a device node at the top of the graph: everything that is wired into this input becomes a layer of it, in the same
/// order. Makes one if there is none. Returns its name. Ids: mixer/full.
Result<std::string> bankBefore (graph::Patch& root, const std::string& sink, const SinkPort&, const Catalogue&);

/// Wires a signal into a new layer of a mixer, or into its only layer if that is empty. Ids: mixer/full.
Result<> addStrip (graph::Patch& root, const std::string& mixer, const graph::Endpoint& from, const std::string& label, const Catalogue&);

/// Mixes everything that reaches a motor. Ids: those of liftSinks.
Result<> mixAll (graph::Graph&, const Catalogue&);

/// An input of a motor that signals reach past the mixers of the graph. A mixer stands straight before it, or before another input.
struct Bypassed
{
    std::string sink, port;             ///< the path of the node, and its input
    std::string mixer;                  ///< path; "" if none stands before this input
    std::vector<std::string> sources;   ///< the ports that go past it: "wall.force"
};

/// Those of a graph with a mixer. Of several instances, the first one counts.
std::vector<Bypassed> bypassedBanks (const graph::Graph&, const Catalogue&);

/// Makes layers of what reaches this input. A motor inside of a subgraph moves to the top of the graph with all others. Ids: those of mixAll.
Result<graph::Command> mixIn (const graph::Graph&, const std::string& sink, std::string_view port, const Catalogue&);

}   // namespace tactus::host::compose
