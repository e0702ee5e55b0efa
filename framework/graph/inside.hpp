// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

namespace tactus::graph
{

/// What a node stands for that is a subgraph, and the graph that is written in.
struct Inside
{
    const Graph* owner = nullptr;
    const Patch* patch = nullptr;

    explicit operator bool() const noexcept { return patch != nullptr; }
};

/// Nothing for a node of the catalogue, and where the subgraph or file is not there.
Inside insideOf (const Graph& owner, const Node&);

}   // namespace tactus::graph
