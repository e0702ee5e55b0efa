// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <framework/graph/edit.hpp>

#include <optional>

namespace tactus::host
{

/// Nine places for all values of a graph, to compare by one key: the params of its nodes, the overrides of its subgraph
/// nodes, and its controls; not the wires. They stand in the file, under `ui`.
inline constexpr int snapshot_count = 9;

bool hasSnapshot (const graph::Graph&, int number);   ///< 1…9

/// Keeps the values as they are now: one step of undo.
graph::Command storeSnapshot (const graph::Graph&, int number);

/// Brings the values back, of whatever is still there: one step of undo. Nothing if there is nothing to change.
std::optional<graph::Command> recallSnapshot (const graph::Graph&, int number);

}   // namespace tactus::host
