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

/// An input of a device node with a mixer before it and with wires that go past this mixer.
struct Bypassed
{
    std::string sink, mixer;
    SinkPort port;
    std::vector<std::string> sources;   ///< the nodes that go past the mixer
};

/// Those at the top of the graph.
std::vector<Bypassed> bypassedBanks (const graph::Graph&);

/// Makes layers of these wires. Ids: mixer/full.
Result<graph::Command> mixIn (const graph::Graph&, const Bypassed&, const Catalogue&);

}   // namespace tactus::host::compose
