// SPDX-License-Identifier: MIT
#pragma once

#include <framework/graph/graph.hpp>

#include <random>

namespace tactus::test
{

/// A graph that compiles, drawn by chance: up to `size` nodes of any type, some inside subgraphs (nested, shared), wires
/// between whole ports and components, delays, gains with units, wires onto parameters with and without (+), bypassed nodes.
graph::Graph randomGraph (unsigned seed, int size);

/// The same graph, its nodes and wires written in another order.
graph::Graph shuffled (graph::Graph, unsigned seed);

}   // namespace tactus::test
