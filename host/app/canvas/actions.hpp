// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Canvas edits as commands. Each is one undo step.

#include "scene.hpp"

#include <tactus/graph/edit.hpp>

#include <optional>
#include <set>

namespace tactus::host
{

using Selection = std::set<graph::Id>;   ///< ids of nodes, wires and notes

/// Stores the positions of nodes in the graph.
graph::Command placeNodes (const graph::Graph&, const std::string& patch, const std::vector<std::pair<graph::Id, juce::Point<float>>>&);

/// This point, or the next one below where a node does not cover another one.
juce::Point<float> freePlace (const Scene&, juce::Point<float>);

/// The same for the box of the node `own`, whose size is known.
juce::Point<float> freePlace (const Scene&, juce::Rectangle<float> box, graph::Id own);

/// This point; if a node covers it, the next place in the row of that node, at its right or at its left.
juce::Point<float> placeInRow (const Scene&, juce::Point<float>, bool to_the_left);

/// Deletes the selection. If a deleted node had exactly one incoming wire, that wire is reconnected to each of the node's
/// destinations that it fits ("healed").
graph::Command removeSelected (const graph::Graph&, const std::string& patch, const Scene&, const Selection&);

/// Lets a wire run through these points.
graph::Command bendWire (const graph::Graph&, const std::string& patch, graph::Id wire, const std::vector<juce::Point<double>>& bends);

/// The places before a move: of the moved nodes, and of the bends of the wires between them.
struct MovedParts
{
    std::vector<std::pair<graph::Id, juce::Point<float>>> nodes;
    std::vector<std::pair<graph::Id, std::vector<juce::Point<double>>>> bends;   ///< by wire
};
MovedParts movedParts (const graph::Graph&, const std::string& patch, const Scene&, const Selection& nodes);
graph::Batch moved (const graph::Graph&, const std::string& patch, const MovedParts&, juce::Point<float> by);

/// Bypasses all selected nodes. If all of them are already bypassed, turns the bypass off.
graph::Command toggleBypass (const graph::Graph&, const std::string& patch, const Selection&);

/// Collapses the selected nodes into a subgraph with a free name.
std::optional<graph::Command> group (const graph::Graph&, const std::string& patch, const Selection&);

/// Adds a node of a type, with a free name derived from the type. Without a place, the canvas finds one. `made` receives its id.
graph::Command addNode (const graph::Graph&, const std::string& patch, const std::string& type, std::optional<juce::Point<float>>, graph::Id& made);

/// Copies the selected nodes and notes next to the originals, with the wires between them and their incoming wires. Empty if
/// nothing selected can be copied.
std::optional<graph::Command> duplicate (const graph::Graph&, const std::string& patch, const Scene&, const Selection&, Selection& made);

/// One end of a new wire: a port, or one component of it.
struct Plug
{
    const SceneNode& node;
    const FacePort& port;
    int component = -1;
};

/// Connects an output to an input or param. Replaces the existing wire if the destination takes only one.
graph::Command connect (const graph::Graph&, const std::string& patch, const Plug& from, const Plug& to);

/// Inserts a node into a wire, through the node's first pair of ports that fit. Empty if no pair fits.
std::optional<graph::Command> insertInto (const graph::Graph&, const std::string& patch, const Scene&, graph::Id wire, graph::Id node);

}   // namespace tactus::host
