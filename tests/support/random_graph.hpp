// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>

#include <optional>
#include <random>
#include <string>

namespace tactus::test
{

/// A random graph that compiles, with up to `size` nodes of any type. Some are inside subgraphs (nested, shared, in
/// several instances with their own values and roles, at their own rates). Wires connect whole ports and components, lead to
/// one instance or to all, and have delays and gains with units; some lead into parameters, with and without (+). Some nodes
/// are bypassed.
graph::Graph randomGraph (unsigned seed, int size);

/// A random node of any type, including the graph's subgraphs, as randomGraph generates them.
graph::Node randomNode (std::mt19937&, std::string name, const graph::Graph&);

/// A random wire between two nodes, if they have ports of the same width. It may fail to compile.
std::optional<graph::Wire> randomWire (std::mt19937&, const graph::Node& from, const graph::Node& to, const graph::Graph&);

/// The same graph with its nodes and wires written in a different order.
graph::Graph shuffled (graph::Graph, unsigned seed);

}   // namespace tactus::test
