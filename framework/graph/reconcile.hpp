// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

namespace tactus::graph
{

/// True if a node of one graph is also a node of the other. It is not so if one of them was read again, or is another graph.
bool haveNodesInCommon (const Graph&, const Graph&);

/// Gives a graph that was read again the ids of the previous graph, so that state survives when a plan made from it takes over.
/// (Ids are not written to files.) In each patch, subgraph and included file of the same name:
///
///   - a node keeps its id if its name and its type are the same;
///   - wires with the same text keep their ids, in order; then wires that differ only in the length of their delay.
///
/// Everything else keeps the id it was read with.
void reconcile (Graph& now, const Graph& before);

}   // namespace tactus::graph
