// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/graph.hpp>
#include <tactus/plan/compile.hpp>

namespace tactus::bench
{

/// Graphs of n filter.one_pole nodes called p0, p1, …, with cutoffs of 200, 210, … Hz that repeat after a hundred nodes.
graph::Graph chainOfOnePoles (int n);   ///< each one feeds the next
graph::Graph treeOfOnePoles (int n);    ///< each one feeds two others; p0 is the root

/// The same graph with its nodes in a random order, as after many edits. The order is the same every time.
graph::Graph shuffled (graph::Graph);

double cutoffOf (int pole);

/// Feeds p0 of a graph of one-poles, and records the nodes that do not feed another node.
CompileOptions endsOf (const graph::Graph&);

}   // namespace tactus::bench
