// SPDX-License-Identifier: MIT
#pragma once

#include <framework/graph/edit.hpp>

#include <random>

namespace tactus::test
{

/// The graph with all its nodes and subgraphs renamed to begin with a prefix, and all its roles replaced by one.
graph::Graph prefixed (graph::Graph, const std::string& prefix, const std::string& role);

/// Both graphs side by side in one. Their names must differ.
graph::Graph besides (graph::Graph, graph::Graph);

/// An edit of what begins with a prefix, as somebody might do who patches without thought: nodes come, go, are renamed
/// and become other ones, wires are drawn, bent and cut, params and settings set. Many do not compile. What begins with
/// anything else is only ever listened to. New device nodes have the role that is given.
graph::Command randomEdit (std::mt19937&, const graph::Graph&, const std::string& prefix, const std::string& role);

/// An edit that changes how a graph is written and not what it means: renames, nodes collapsed to subgraphs, subgraphs
/// expanded. It may be refused.
graph::Command randomRegrouping (std::mt19937&, const graph::Graph&);

}   // namespace tactus::test
