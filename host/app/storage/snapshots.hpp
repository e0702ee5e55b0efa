// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <tactus/graph/edit.hpp>

#include <functional>
#include <optional>
#include <string>
#include <vector>

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

/// The nodes of a snapshot that the graph no longer has, or that have another type now: recalling leaves them out.
std::vector<std::string> missingNodes (const graph::Graph&, int number);

/// The names of the controls that a snapshot does not hold, because they were added later: what they set stays when it is recalled.
std::vector<std::string> laterControls (const graph::Graph&, int number);

/// The member "snapshots" of `ui`, as it is after a command that renames, groups or ungroups nodes, moves the layers of a mixer, or removes a control: each
/// snapshot goes on holding the same nodes, under their new names, the same layers, and the values that it held by the control. `commandFor` returns the
/// command for the graph with the values of a snapshot. Null if there are no snapshots.
Json snapshotsAfter (const graph::Graph& before, const std::function<graph::Command (const graph::Graph&)>& commandFor);

/// True if the snapshot exists, and all values are those that it holds, so that recalling it would change nothing.
bool isAtSnapshot (const graph::Graph&, int number);

}   // namespace tactus::host
