// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/edit.hpp>

#include <optional>

namespace tactus::host
{

/// The nine snapshots of a graph, for A/B comparison at a key press. A snapshot holds the params of all nodes, the overrides of
/// subgraph nodes, and the controls, but not the wires. Snapshots are stored in the graph file, under `ui`.
inline constexpr int snapshot_count = 9;

bool hasSnapshot (const graph::Graph&, int number);   ///< 1…9

/// Stores the current values. One undo step.
graph::Command storeSnapshot (const graph::Graph&, int number);

/// Empties a snapshot. One undo step.
graph::Command clearSnapshot (const graph::Graph&, int number);

/// Restores the values of everything that still exists. One undo step. Empty if nothing would change.
std::optional<graph::Command> recallSnapshot (const graph::Graph&, int number);

/// True if the snapshot exists, and all values are those that it holds, so that recalling it would change nothing.
bool isAtSnapshot (const graph::Graph&, int number);

}   // namespace tactus::host
