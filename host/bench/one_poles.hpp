// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/graph.hpp>
#include <framework/plan/compile.hpp>

namespace tactus::bench
{

/// Graphs of n nodes filter.one_pole, called p0, p1, …, with cutoffs of 200, 210, … Hz that start again after a hundred.
graph::Graph chainOfOnePoles (int n);   ///< each fed by the one before
graph::Graph treeOfOnePoles (int n);    ///< each feeds two, p0 all

/// The same graph with its nodes in no order, as one that was edited for long; the same each time.
graph::Graph shuffled (graph::Graph);

double cutoffOf (int pole);

/// What feeds a graph of one-poles, and which of them are its outputs: those that feed no other.
CompileOptions endsOf (const graph::Graph&);

}   // namespace tactus::bench
