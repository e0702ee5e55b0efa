// SPDX-License-Identifier: MIT
#pragma once

#include <framework/graph/graph.hpp>

#include <cstdint>

namespace tactus::test
{

/// A graph that no person would draw and every reader must bear: subgraphs, wires of all kinds, controls with paths
/// into subgraphs, unknown keys, names in several scripts, numbers at the edges. The same for the same seed. Its wires
/// and controls join nodes that exist; ports and types are made up.
graph::Graph wildGraph (std::uint64_t seed);

}   // namespace tactus::test
