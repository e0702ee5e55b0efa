// SPDX-License-Identifier: MIT
#pragma once

#include <tactus/graph/graph.hpp>

#include <string>
#include <vector>

namespace tactus
{

/// A guard that an included graph ("file:") describes for one of its roles.
struct IncludedGuard
{
    std::string role;   ///< as the whole graph calls it, after the `roles` of all subgraph nodes around
    Json guard;
    std::string file, where;   ///< for messages: the file as written in the type of the subgraph node, and the place of the guard in it

    bool operator== (const IncludedGuard&) const = default;
};

/// The guards of all graphs that a graph includes, each once. The author of an included graph has set them for its forces, so they
/// tighten the guards of the whole graph. The graph must have been compiled: this limits how many instances it has. [main thread]
std::vector<IncludedGuard> includedGuards (const graph::Graph&);

}   // namespace tactus
