// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

namespace tactus::graph
{

/// Gives a graph that was read anew the ids of what it has in common with the one before, so that state lives on when a
/// plan made from it takes over: ids are not written to files. In each patch, subgraph and included file of the same name
///
///   - a node keeps its id if its name and its type are the same;
///   - wires of the same text keep theirs, in order; then those that differ in nothing but their delay.
///
/// What has no like keeps the id it was read with.
void reconcile (Graph& now, const Graph& before);

}   // namespace tactus::graph
