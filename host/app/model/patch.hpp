// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>

#include <optional>
#include <string>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Finds a patch by name: "" is the graph itself. Null if there is no such subgraph.
inline const graph::Patch* findPatch (const graph::Graph& g, const std::string& name) { return name.empty() ? &g.root : g.find (name); }

/// Reads a pair of numbers such as "at" or "size" from a JSON object. Empty unless both are within ±1e6.
std::optional<juce::Point<double>> readPoint (const Json& object, const char* key);

/// The position stored in a node's `ui`, in canvas units. Empty if there is none.
std::optional<juce::Point<double>> positionOf (const graph::Node&);

}   // namespace tactus::host
