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

/// Copies nodes and the wires between them as text: a complete graph file that includes the subgraphs they use.
std::string copyText (const graph::Graph&, const std::string& patch, const std::set<graph::Id>& nodes);

/// Pastes copied text into a patch as one undo step, under free names and moved by `offset`, or further where a node would
/// cover another one completely. `made` receives the ids of the new nodes. Fails if the text is not a graph.
Result<graph::Command> paste (const graph::Graph&, const std::string& patch, const std::string& text, juce::Point<double> offset,
                              std::set<graph::Id>& made);

/// The upper left corner of the nodes in copied text. Empty if no node has a position.
std::optional<juce::Point<double>> cornerOf (const std::string& text);

/// The name of a new node of this type, if nothing else names it.
std::string usualName (const std::string& type);

/// Returns `wanted` if it is free, else the same name with the next free number, such as "drag_2".
std::string freeName (const graph::Patch&, const std::set<std::string>& also_taken, const std::string& wanted);

/// The name of a node for what the user types: "soft_pad" for "Soft pad".
std::string asNodeName (const juce::String& typed);

/// Exposes a port of a node inside a subgraph under a free name, or hides it again.
graph::Command toggleExposed (const graph::Graph&, const std::string& subgraph, const std::string& node, const FacePort&);

}   // namespace tactus::host
