// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

namespace tactus::graph
{

/// The patch inside a subgraph node, and the graph that contains the patch.
struct Inside
{
    const Graph* owner = nullptr;
    const Patch* patch = nullptr;

    explicit operator bool() const noexcept { return patch != nullptr; }
};

/// The inside of a subgraph node. Empty for a node of the catalogue, and if the subgraph or file does not exist.
Inside insideOf (const Graph& owner, const Node&);

}   // namespace tactus::graph
