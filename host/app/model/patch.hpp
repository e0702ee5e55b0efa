// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <juce_graphics/juce_graphics.h>

namespace tactus::host
{

/// Finds a patch by name: "" is the graph itself. Null if there is no such subgraph.
inline const graph::Patch* findPatch (const graph::Graph& g, const std::string& name) { return name.empty() ? &g.root : g.find (name); }

/// A patch as one sees it: its name, and the subgraph nodes through which one has entered it.
struct SeenPatch
{
    SeenPatch (std::string n = {}, std::string p = {}) : name (std::move (n)), path (std::move (p)) {}
    SeenPatch (const char* n) : name (n) {}

    std::string name;   ///< "" is the graph itself
    std::string path;   ///< such as "grain/wave/"; "" in the graph itself, or if one has not entered the patch

    /// The name that controls use for a parameter of this patch: "grain/wave/drag.mu". Empty if one has not entered the patch.
    std::string address (const std::string& param) const { return name.empty() || ! path.empty() ? path + param : std::string(); }

    bool operator== (const SeenPatch&) const = default;
};

/// Reads a pair of numbers such as "at" or "size" from a JSON object. Empty unless both are within ±1e6.
std::optional<juce::Point<double>> readPoint (const Json& object, const char* key);

/// The position stored in a node's `ui`, in canvas units. Empty if there is none.
std::optional<juce::Point<double>> positionOf (const graph::Node&);

/// The bends stored in a wire's `ui`: the points through which it runs, from its start to its end. None, if one of them is not a point.
std::vector<juce::Point<double>> bendsOf (const graph::Wire&);
graph::Wire withBends (graph::Wire, const std::vector<juce::Point<double>>&);

}   // namespace tactus::host
