// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// What people do on a canvas, as commands. Each is one step of undo.

#include "scene.hpp"

#include <framework/graph/edit.hpp>

#include <optional>
#include <set>

namespace tactus::host
{

using Selection = std::set<graph::Id>;   ///< nodes and wires

/// Writes the places of nodes into the graph.
graph::Command placeNodes (const graph::Graph&, const std::string& patch, const std::vector<std::pair<graph::Id, juce::Point<float>>>&);

/// Takes what is selected away. Where a node had one wire in and its outputs could carry on what it carried, the wire goes
/// through: "healed".
graph::Command removeSelected (const graph::Graph&, const std::string& patch, const Scene&, const Selection&);

/// All of them if any is not bypassed yet, else none.
graph::Command toggleBypass (const graph::Graph&, const std::string& patch, const Selection&);

/// Makes a subgraph of the selected nodes, under free names.
std::optional<graph::Command> group (const graph::Graph&, const std::string& patch, const Selection&);

/// A node of a type at a place, under a free name made of its type; its id is filled in.
graph::Command addNode (const graph::Graph&, const std::string& patch, const std::string& type, juce::Point<float>, graph::Id& made);

/// A copy of the selected nodes and notes beside them, with the wires among them and those that come in from others. Nothing
/// if nothing is selected that can be copied.
std::optional<graph::Command> duplicate (const graph::Graph&, const std::string& patch, const Scene&, const Selection&, Selection& made);

/// A wire from an output to an input or param, or a component of either. If only one wire fits there, it takes the place of
/// the one that is there.
graph::Command connect (const graph::Graph&, const std::string& patch, const SceneNode& from, const FacePort&, const SceneNode& to, const FacePort&, int from_component = -1, int to_component = -1);

/// A node that stands on a wire goes into it, by its first ports that fit; nothing if none do.
std::optional<graph::Command> insertInto (const graph::Graph&, const std::string& patch, const Scene&, graph::Id wire, graph::Id node);

/// Shows a port of a node of a subgraph to its outside, under a free name, or hides it again.
graph::Command toggleExposed (const graph::Graph&, const std::string& subgraph, const std::string& node, const FacePort&);

}   // namespace tactus::host
