// SPDX-License-Identifier: MIT
#pragma once

#include "graph.hpp"

#include <string>
#include <utility>
#include <vector>

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

/// The port inside that a subgraph exposes as this endpoint of a patch, however deep, and without "[*]"; the endpoint itself if none does. `list`: what the
/// endpoint may be, such as &Expose::params.
Endpoint innermost (const Graph&, const Patch&, Endpoint, std::vector<std::pair<std::string, Endpoint>> Expose::*list);

}   // namespace tactus::graph
