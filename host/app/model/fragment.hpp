// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "face.hpp"

#include <tactus/graph/edit.hpp>
#include <tactus/text/result.hpp>

#include <optional>
#include <set>
#include <string>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Copies nodes and the wires between them as a graph of their own, with the subgraphs they use, and, from the top of a graph, with their devices and the
/// controls that turn them. It has the name and the folder of the graph.
graph::Graph fragmentOf (const graph::Graph&, const std::string& patch, const std::set<graph::Id>& nodes);

/// The same as text: a complete graph file.
std::string copyText (const graph::Graph&, const std::string& patch, const std::set<graph::Id>& nodes);

/// Reads text that may come from another program, within the budgets of a graph file. Fails if it is not a graph, or has errors. Ids: those of readGraph.
Result<graph::Graph> readCopied (const std::string& text);

/// Gives the nodes and wires of a patch new identities, so that it can be added twice.
void renewIds (graph::Patch&);

/// Pastes copied nodes into a patch as one undo step, under free names and moved by `offset`, or further where a node would
/// cover another one completely. A subgraph whose name is taken by another one gets a new name. Roles without a device get that of the copied graph.
/// Its controls are left out. `made` receives the ids of the new nodes.
Result<graph::Command> paste (const graph::Graph&, const std::string& patch, graph::Graph copied, juce::Point<double> offset,
                              std::set<graph::Id>& made);

/// The upper left corner of the nodes. Empty if no node has a position.
std::optional<juce::Point<double>> cornerOf (const graph::Patch&);

/// The name of a new node of this type, if nothing else names it.
std::string usualName (const std::string& type);

/// The description of a role that the window adds to a graph: a simulated tool in a hand that strokes, with the guard of the templates.
Json newTool();

/// Returns `wanted` if it is free, else the same name with the next free number, such as "drag_2".
std::string freeName (const graph::Patch&, const std::set<std::string>& also_taken, const std::string& wanted);

/// The name of a node for what the user types: "soft_pad" for "Soft pad".
std::string asNodeName (const juce::String& typed);

/// Exposes a port of a node inside a subgraph under a free name, or hides it again.
graph::Command toggleExposed (const graph::Graph&, const std::string& subgraph, const std::string& node, const FacePort&);

/// A param as a node of a patch has it.
struct NodeParam
{
    std::string node, param;
};

/// The param of a node of this patch through which the one at a path is reached: "wood" and "mu" for "wood/drag.mu". Adds to `batch` what exposes it first,
/// where no subgraph on the path does. Empty if the path leads to no node.
std::optional<NodeParam> paramThrough (const graph::Graph&, const std::string& patch, const std::string& path, graph::Batch& batch);

}   // namespace tactus::host
