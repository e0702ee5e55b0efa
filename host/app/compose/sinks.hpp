// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// The inputs through which signals leave a graph for its devices, and their move to the top of the graph, where a mixer can be put before them.

#include <tactus/graph/graph.hpp>
#include <tactus/text/result.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace tactus::host::compose
{

/// An input of a device node whose signal reaches a motor.
struct SinkPort
{
    std::string_view type, port;
    bool is_vector = false;
};

/// The inputs of a node that reach a motor. None for other nodes, and for one that is bypassed. A brake takes no force, so it is none.
std::vector<SinkPort> sinkPortsOf (const graph::Node&);

/// A signal that a patch gives to a motor outside of it: an exposed output, and the device node that was inside.
struct LiftedSink
{
    std::string output;
    graph::Node sink;   ///< type, role, params and settings
    SinkPort port;
};

/// Takes the device nodes with a motor out of a patch, and exposes their input signals as outputs. Several wires into one input are summed by a mixer in
/// the patch. A device node to which something else refers stays, without a signal. Ids: mixer/full.
Result<std::vector<LiftedSink>> takeSinks (graph::Patch&);

/// Moves all motors that are inside subgraphs to the top of the graph, and wires the same signals to them: one motor for each role, and a wire from each
/// instance. Ids: mixer/full; compose/in_file if a motor is in a subgraph of another file, compose/in_path if a wire from outside names one.
Result<> liftSinks (graph::Graph&);

/// The device node of this kind and role at the top of the graph; added if there is none.
std::string sinkFor (graph::Patch& root, const LiftedSink&, const std::string& role);

/// The roles that the nodes of a graph use, with all its subgraphs, in the order in which they appear.
std::vector<std::string> rolesIn (const graph::Graph&);

}   // namespace tactus::host::compose
