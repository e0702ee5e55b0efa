// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/edit.hpp>

#include <random>

namespace tactus::test
{

/// Adds a prefix to the names of all nodes and subgraphs, and replaces all roles by one.
graph::Graph prefixed (graph::Graph, const std::string& prefix, const std::string& role);

/// Combines both graphs side by side. Their names must differ.
graph::Graph sideBySide (graph::Graph, graph::Graph);

/// A random edit of nodes whose names begin with the prefix, like the edits of a careless user: nodes are added, removed,
/// renamed or given other types; wires are added, changed or removed; params and settings are set. Many edits do not compile.
/// Other nodes are used only as starts of wires. New device nodes get the given role.
graph::Command randomEdit (std::mt19937&, const graph::Graph&, const std::string& prefix, const std::string& role);

/// A random edit that changes how a graph is written but not its meaning: renames nodes, collapses nodes into
/// subgraphs, expands subgraphs. It may be refused.
graph::Command randomRegrouping (std::mt19937&, const graph::Graph&);

}   // namespace tactus::test
