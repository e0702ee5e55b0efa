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
    std::string role;   ///< its name in the whole graph: the `roles` of all enclosing subgraph nodes are applied
    Json guard;
    std::string file, where;   ///< for messages: the file as written in the type of the subgraph node, and the place of the guard in it

    bool operator== (const IncludedGuard&) const = default;
};

/// The guards of all graphs that a graph includes, without duplicates. The author of an included graph has chosen its guards for its
/// forces, so they tighten the guards of the whole graph. The graph must have compiled, because compiling limits the number of
/// instances. [main thread]
std::vector<IncludedGuard> includedGuards (const graph::Graph&);

/// The description of a device, without the guard: an edit can change that while the graph runs.
Json withoutGuard (Json description);

}   // namespace tactus
