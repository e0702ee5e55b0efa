// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

namespace tactus::graph
{

/// The ids of all nodes and wires of a graph, in file order, without those of included files. (The file itself does not hold ids.)
/// A copy is stored as a list of its id and its origin; the origin is a list of pairs of an id and an instance number.
Json idsOf (const Graph&);

/// Restores the ids of a graph that has been read from its file again. Returns false if their number differs, or they are not ids.
bool giveIds (Graph&, const Json&);

}   // namespace tactus::graph
