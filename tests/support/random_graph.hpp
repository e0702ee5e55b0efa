// SPDX-License-Identifier: MIT
#pragma once

#include <framework/graph/graph.hpp>

#include <optional>
#include <random>
#include <string>

namespace tactus::test
{

/// A graph that compiles, drawn by chance: up to `size` nodes of any type, some inside subgraphs (nested, shared, in several
/// instances with values and roles of their own, at rates of their own), wires between whole ports and components, to one
/// instance and to all, delays, gains with units, wires onto parameters with and without (+), bypassed nodes.
graph::Graph randomGraph (unsigned seed, int size);

/// A node of any type, subgraphs of the graph among them, as randomGraph draws them.
graph::Node randomNode (std::mt19937&, std::string name, const graph::Graph&);

/// A wire between two nodes, if they have ports of one width; it need not compile.
std::optional<graph::Wire> randomWire (std::mt19937&, const graph::Node& from, const graph::Node& to, const graph::Graph&);

/// The same graph, its nodes and wires written in another order.
graph::Graph shuffled (graph::Graph, unsigned seed);

}   // namespace tactus::test
