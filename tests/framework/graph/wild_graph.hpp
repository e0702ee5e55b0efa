// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>

#include <cstdint>

namespace tactus::test
{

/// A graph that no user would build, but that every reader must accept: subgraphs, wires of all kinds, controls with paths
/// into subgraphs, unknown keys, names in several scripts, extreme numbers. The same seed gives the same graph. Its wires
/// and controls refer to existing nodes; ports and types are made up.
graph::Graph wildGraph (std::uint64_t seed);

}   // namespace tactus::test
