// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

namespace tactus::graph
{

/// The ids of all nodes and wires of a graph, without those of the files it includes, in the order in which they stand in
/// its file, which does not hold them. What is a copy comes as a list of its id and its
/// origin, which is a list of ids, each with the number of an instance.
Json idsOf (const Graph&);

/// Gives a graph that was read from its file the ids it had. False if there are not as many, or they are none.
bool giveIds (Graph&, const Json&);

}   // namespace tactus::graph
