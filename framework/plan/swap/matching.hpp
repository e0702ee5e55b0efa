// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/plan/flat/flat.hpp>

namespace tactus::plan
{

/// For each node of a graph, and for each wire that is delayed or changes rate: the number of its counterpart in the previous
/// graph, or -1.
struct Matching
{
    std::vector<int> nodes, wires;
};

/// Matches two graphs by ids: the node's own, the ids of the subgraph nodes that enclose it, and their instance numbers. A copy
/// is treated as its original. Subgraph nodes that exist in only one of the graphs are ignored, so collapsing or expanding does
/// not break matches. An id that is still unmatched and occurs exactly once on each side has moved; it matches too. When one
/// wire of the graph becomes several between instances, the nodes at their ends distinguish them.
Matching matchGraphs (const Flat& now, const Flat& before);

}   // namespace tactus::plan
